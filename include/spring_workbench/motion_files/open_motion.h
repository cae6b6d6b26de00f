#pragma once

#include <memory>
#include <string>

#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::motion_files {

/// A motion from a file: a script (see ScriptedSource) where the name ends in `.yaml` or `.yml`, else a recording (see
/// read_motion_file). Throws InputError as these do.
std::unique_ptr<motion::StylusSource> open_motion(const std::string& path);

}  // namespace spring_workbench::motion_files
