#include "message_source.h"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "constants.h"
#include "spring_workbench/ros/common/loop_clock.h"

namespace spring_workbench::tracker_driver {

std::vector<motion::StationSample> MessageSource::read(double timeout) {
  const double wait = last_ + message_interval - ros_common::steady_time();
  if (wait > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(std::min(wait, timeout)));
  ros::getGlobalCallbackQueue()->callAvailable();
  const double now = ros_common::steady_time();
  if (now < last_ + message_interval) return {};
  const bool on_time = now < last_ + 2.0 * message_interval;
  motion::StationSample sample;
  sample.received = on_time ? last_ + message_interval : now;
  const RigidTransform& X = advance(last_ > 0.0 ? sample.received - last_ : 0.0, sample);
  sample.p_TS = X.translation();
  sample.q_TS = Quaterniond(X.linear());
  last_ = sample.received;
  return {sample};
}

}  // namespace spring_workbench::tracker_driver
