#include "spring_workbench/motion_files/open_motion.h"

#include "spring_workbench/motion_files/motion_file.h"
#include "spring_workbench/motion_files/scripted_source.h"

namespace spring_workbench::motion_files {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::unique_ptr<motion::StylusSource> open_motion(const std::string& path) {
  if (ends_with(path, ".yaml") || ends_with(path, ".yml")) return std::make_unique<ScriptedSource>(path);
  return std::make_unique<RecordedSource>(read_motion_file(path));
}

}  // namespace spring_workbench::motion_files
