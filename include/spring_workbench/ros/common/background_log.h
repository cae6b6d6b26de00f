#pragma once

namespace spring_workbench::ros_common {

/// Passes log lines to the terminal and to /rosout from two threads of their own from now on, so that no other thread
/// is blocked: neither by a terminal that does not read (Ctrl-S, a pager, a full pipe) nor by a ROS master that does
/// not answer, for which roscpp lets each line wait while it sets a parameter. Lines beyond the capacity of a queue are
/// dropped, and a later line reports how many. Call once, after roscpp was started with ros::init_options::NoRosout.
void log_in_background();

/// Whether standard error can take a line without blocking.
bool error_output_takes_more();

}  // namespace spring_workbench::ros_common
