#include "message_source.h"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace spring_workbench::tracker_driver {
namespace {

double steady_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

std::vector<motion::StationSample> MessageSource::read(double timeout) {
  constexpr double interval = 1.0 / 60.0;  // [s]
  const double wait = last_ + interval - steady_now();
  if (wait > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(std::min(wait, timeout)));
  ros::getGlobalCallbackQueue()->callAvailable();
  const double now = steady_now();
  if (now < last_ + interval) return {};
  const bool on_time = now < last_ + 2.0 * interval;
  motion::StationSample sample;
  sample.received = on_time ? last_ + interval : now;
  advance(last_ > 0.0 ? sample.received - last_ : 0.0, sample);
  last_ = sample.received;
  return {sample};
}

}  // namespace spring_workbench::tracker_driver
