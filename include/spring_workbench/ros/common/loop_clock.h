#pragma once

#include <ros/time.h>

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

#include "spring_workbench/hand_input/local_time.h"
#include "spring_workbench/motion/stream_clock.h"

namespace spring_workbench::ros_common {

/// Time of a monotonic clock [s].
double steady_time();

/// Local time for measuring intervals [s]: ROS time under `use_sim_time`, otherwise the steady clock.
double loop_time();

/// The current time by both clocks.
hand_input::LocalTime local_time();

/// The current ROS time without the steps of the wall clock; under `use_sim_time`, simulated time.
motion::WallMoment wall_moment();

/// Converts a stamp of the simulation [ns], a time of wall_moment(), to the current clock. Returns the current time if
/// there is no stamp.
ros::Time stamp_of(const std::optional<std::int64_t>& stamp);

/// ROS time at which the steady clock showed `t` [s].
ros::Time ros_time(double t);

/// Sleeps until `loop_time()` reaches `t`. Under `use_sim_time` it also returns if the clock jumps back, if it has been
/// stopped for 0.1 s, or on shutdown.
void sleep_until_loop_time(double t);

/// Wakes a sleeping thread.
class Alarm {
 public:
  /// Ends the current sleep or, if there is none, the next one immediately.
  void ring();
  /// Like sleep_until_loop_time(), but returns early if another thread calls ring().
  void sleep_until(double t);

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  bool rung_ = false;
};

}  // namespace spring_workbench::ros_common
