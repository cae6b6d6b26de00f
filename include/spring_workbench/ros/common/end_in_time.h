#pragma once

#include <cstdlib>
#include <functional>

namespace spring_workbench::ros_common {

/// Ends this process 1.5 s after `ends` has become true, if it has not ended by then: a ROS master that is gone or
/// hangs does not keep a node from its end. `ends` is called in a thread of its own.
void end_in_time(std::function<bool()> ends, int status = EXIT_SUCCESS);
/// The same after `timeout` [s].
void end_in_time(std::function<bool()> ends, int status, double timeout);

}  // namespace spring_workbench::ros_common
