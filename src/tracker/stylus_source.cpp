#include "spring_workbench/tracker/stylus_source.h"

#include "spring_workbench/tracker/motion_file.h"
#include "spring_workbench/tracker/scripted_source.h"

namespace spring_workbench {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::unique_ptr<StylusSource> open_motion(const std::string& path) {
  if (ends_with(path, ".yaml") || ends_with(path, ".yml")) return std::make_unique<ScriptedSource>(path);
  return std::make_unique<RecordedSource>(read_motion_file(path));
}

}  // namespace spring_workbench
