#include "spring_workbench/ros/common/rejections.h"

#include <ros/console.h>

#include "constants.h"
#include "spring_workbench/ros/common/loop_clock.h"

namespace spring_workbench::ros_common {

void Rejections::add(const std::string& reason, const std::string& line) {
  ++counts_[reason];
  const double now = steady_time();
  const auto told = told_.find(reason);
  if (told != told_.end() && now - told->second < told_again_after) return;
  told_[reason] = now;
  ROS_WARN_STREAM(line << "; rejected");
}

}  // namespace spring_workbench::ros_common
