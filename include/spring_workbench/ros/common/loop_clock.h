#pragma once

#include <ros/time.h>

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

#include "spring_workbench/hand_input/local_time.h"
#include "spring_workbench/motion/stream_clock.h"

namespace spring_workbench::ros_common {

/// [s], a clock that does not go back.
double steady_time();

/// Local time [s] that intervals are measured with: ROS time under `use_sim_time`, else the steady clock.
double loop_time();

/// Now by both clocks.
hand_input::LocalTime local_time();

/// ROS time now, without the steps of the wall clock; under `use_sim_time` simulated time.
motion::WallMoment wall_moment();

/// Converts a stamp of the simulation [ns], a time of wall_moment(), to the present clock; without one, the present.
ros::Time stamp_of(const std::optional<std::int64_t>& stamp);

/// ROS time at which the steady clock showed `t` [s].
ros::Time ros_time(double t);

/// Sleeps until `loop_time()` is `t`. Under `use_sim_time` it also returns when the clock goes back, when it stood for
/// 0.1 s, and on shutdown.
void sleep_until_loop_time(double t);

/// Wakes one thread that sleeps.
class Alarm {
 public:
  /// Ends the present sleep, or the next at once.
  void ring();
  /// As sleep_until_loop_time(), or until another thread rings.
  void sleep_until(double t);

 private:
  std::mutex mutex_;
  std::condition_variable bell_;
  bool rung_ = false;
};

}  // namespace spring_workbench::ros_common
