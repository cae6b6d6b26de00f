#include "message_source.h"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>

namespace spring_workbench {
namespace {

double steady_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

std::vector<StationSample> MessageSource::read(double timeout) {
  constexpr double interval = 1.0 / 60.0;  // [s]
  const double until = std::min(steady_now() + timeout, last_ + interval);
  for (double now = steady_now(); ros::ok() && now < until; now = steady_now()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(until - now));
  }
  const double now = steady_now();
  if (now < last_ + interval) return {};
  const bool on_time = now < last_ + 2.0 * interval;
  const double due = on_time ? last_ + interval : now;
  StationSample sample;
  sample.received = due;
  advance(last_ > 0.0 ? due - last_ : 0.0, sample);
  last_ = due;
  return {sample};
}

}  // namespace spring_workbench
