#pragma once

#include <memory>
#include <string>

#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::motion_files {

/// Opens a motion file: a script of waypoints if the name ends in `.yaml` or `.yml`, otherwise a recording: lines of
/// `t x y z qx qy qz qw [button]` in s and m, with w as the last number of the quaternion (the constructor of
/// Quaterniond takes it first). Throws InputError with file, line, rule and value for one that is invalid.
std::unique_ptr<motion::StylusSource> open_motion(const std::string& path);

}  // namespace spring_workbench::motion_files
