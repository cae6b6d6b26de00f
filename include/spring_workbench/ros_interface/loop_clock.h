#pragma once

#include <ros/time.h>

namespace spring_workbench {

/// Local time [s] that intervals are measured with: ROS time under `use_sim_time`, else the steady clock.
double loop_time();

/// One moment by both clocks [s]: the one of `loop_time`, and the steady one.
struct LocalTime {
  double loop = 0.0;
  double wall = 0.0;
};
LocalTime local_time();

/// Sleeps until `loop_time()` is `t`. Under `use_sim_time` it also returns when the clock goes back, when it stood for
/// 0.1 s, and on shutdown.
void sleep_until_loop_time(double t);

}  // namespace spring_workbench
