#include "spring_workbench/ros/common/rejections.h"

#include <ros/console.h>

#include "constants.h"
#include "spring_workbench/ros/common/loop_clock.h"

namespace spring_workbench::ros_common {

void Rejections::add(const std::string& reason, const std::string& line) {
  count(reason);
  const double now = steady_time();
  const auto last = last_logged_.find(reason);
  if (last != last_logged_.end() && now - last->second < log_period) return;
  last_logged_[reason] = now;
  ROS_WARN_STREAM("rejected: " << line);
}

void Rejections::add_loop_stalled(const std::string& place) {
  add("the loop is stalled",
      place + "the physics loop is busy, and its queue is full (see \"physics loop\" on /diagnostics)");
}

}  // namespace spring_workbench::ros_common
