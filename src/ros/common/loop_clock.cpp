#include "spring_workbench/ros/common/loop_clock.h"

#include <ros/init.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

#include "constants.h"

namespace spring_workbench::ros_common {

using std::chrono::duration;
using std::chrono::duration_cast;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

namespace {

/// ROS time and the steady clock at one moment [ns].
struct Reading {
  std::int64_t ros, steady;
};

/// Reads both clocks in succession, and again if the process was interrupted in between.
Reading read_clocks() {
  const auto steady = [] { return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count(); };
  Reading reading{};
  for (int attempt = 0; attempt < 5; ++attempt) {
    reading.steady = steady();
    reading.ros = static_cast<std::int64_t>(ros::Time::now().toNSec());
    if (steady() - reading.steady < clocks_apart) break;
  }
  return reading;
}

void sleep_until_simulated(double t) {
  const double give_up = steady_time() + stopped_clock_timeout, begin = loop_time();
  for (double now = begin; now >= begin && now < t && steady_time() < give_up && ros::ok(); now = loop_time()) {
    std::this_thread::sleep_for(duration<double>(clock_poll));
  }
}

double running_time(double wall) {
  static std::mutex mutex;
  static double last = wall, running = 0.0;
  const std::lock_guard<std::mutex> lock(mutex);
  running += std::clamp(wall - last, 0.0, max_running_increase);
  last = std::max(last, wall);
  return running;
}

}  // namespace

double steady_time() { return duration<double>(steady_clock::now().time_since_epoch()).count(); }

double loop_time() { return local_time().loop; }

hand_input::LocalTime local_time() {
  const double wall = steady_time();
  return {ros::Time::isSimTime() ? ros::Time::now().toSec() : wall, running_time(wall)};
}

motion::WallMoment wall_moment() {
  static motion::WallClock clock;
  const Reading reading = read_clocks();
  if (ros::Time::isSimTime()) return {reading.ros, 0};
  motion::WallMoment moment = clock.read(reading.ros, reading.steady);
  const hand_input::LocalTime now = local_time();
  moment.not_running = std::llround(1e9 * (now.loop - now.running));
  return moment;
}

ros::Time stamp_of(const std::optional<std::int64_t>& stamp) {
  const motion::WallMoment moment = wall_moment();
  return ros::Time().fromNSec(static_cast<std::uint64_t>(stamp.value_or(moment.now) + moment.steps));
}

ros::Time ros_time(double t) {
  const Reading reading = read_clocks();
  return ros::Time().fromNSec(static_cast<std::uint64_t>(reading.ros)) -
         ros::Duration(1e-9 * static_cast<double>(reading.steady) - t);
}

void sleep_until_loop_time(double t) {
  if (ros::Time::isSimTime()) return sleep_until_simulated(t);
  std::this_thread::sleep_until(steady_clock::time_point(duration_cast<steady_clock::duration>(duration<double>(t))));
}

void Alarm::ring() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    rung_ = true;
  }
  condition_.notify_one();  // the other thread does not have to wait for the lock
}

void Alarm::sleep_until(double t) {
  const bool simulated = ros::Time::isSimTime();
  const double give_up = steady_time() + stopped_clock_timeout, begin = loop_time();
  std::unique_lock<std::mutex> lock(mutex_);
  // Sleep in slices, because a simulated clock has to be polled, and time counts as running only while it is.
  for (double now = begin; !rung_ && now < t && ros::ok(); now = loop_time()) {
    if (simulated && (now < begin || steady_time() >= give_up)) break;
    condition_.wait_for(lock, duration<double>(simulated ? clock_poll : std::min(t - now, max_running_increase)));
  }
  rung_ = false;
}

}  // namespace spring_workbench::ros_common
