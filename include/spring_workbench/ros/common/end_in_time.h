#pragma once

#include <functional>

namespace spring_workbench::ros_common {

/// Ends this process 1.5 s after `ends` has become true, if it has not ended by then: a ROS master that is gone or
/// hangs does not keep a node from its end. `ends` is called in a thread of its own.
void end_in_time(std::function<bool()> ends);

}  // namespace spring_workbench::ros_common
