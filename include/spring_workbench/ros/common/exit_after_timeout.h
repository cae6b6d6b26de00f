#pragma once

#include <cstdlib>
#include <functional>

namespace spring_workbench::ros_common {

/// Forces this process to exit with `status` 1.5 s after `ends` becomes true, if it is still running, so that a ROS
/// master that is gone or hangs cannot keep a node alive. `ends` is called in a thread of its own.
void exit_after_timeout(std::function<bool()> ends, int status = EXIT_SUCCESS);
/// Does the same after `timeout` [s].
void exit_after_timeout(std::function<bool()> ends, int status, double timeout);

}  // namespace spring_workbench::ros_common
