#pragma once

#include <memory>
#include <string>

#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::motion_files {

/// Opens a motion file. A file whose name ends in `.yaml` or `.yml` is a script of waypoints. Any other file is a
/// recording with lines of `t x y z qx qy qz qw [button]` in s and m; w is the last number of the quaternion, although
/// the constructor of Quaterniond takes it first. Throws InputError, with file, line, rule and value, if the file
/// cannot be read or is invalid.
std::unique_ptr<motion::StylusSource> open_motion(const std::string& path);

}  // namespace spring_workbench::motion_files
