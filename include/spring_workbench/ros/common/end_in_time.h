#pragma once

#include <functional>

namespace spring_workbench::ros_common {

/// Ends this process `timeout` [s] after `ends` has become true, if it has not ended by then: a ROS master that is gone
/// or hangs does not keep a node from its end. Without a `timeout` it is 1.5 s, that of nodes. `ends` is called in a
/// thread of its own.
void end_in_time(std::function<bool()> ends);
void end_in_time(std::function<bool()> ends, double timeout);

}  // namespace spring_workbench::ros_common
