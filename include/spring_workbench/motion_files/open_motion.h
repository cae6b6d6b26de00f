#pragma once

#include <memory>
#include <string>

#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::motion_files {

/// Opens a motion file: a script (see ScriptedSource) if the name ends in `.yaml` or `.yml`, otherwise a recording (see
/// read_motion_file). Throws InputError as they do.
std::unique_ptr<motion::StylusSource> open_motion(const std::string& path);

}  // namespace spring_workbench::motion_files
