#pragma once

#include <ros/time.h>

#include "spring_workbench/hand_input/local_time.h"

namespace spring_workbench::ros_common {

/// [s], a clock that does not go back.
double steady_time();

/// Local time [s] that intervals are measured with: ROS time under `use_sim_time`, else the steady clock.
double loop_time();

/// Now by both clocks.
hand_input::LocalTime local_time();

/// Sleeps until `loop_time()` is `t`. Under `use_sim_time` it also returns when the clock goes back, when it stood for
/// 0.1 s, and on shutdown.
void sleep_until_loop_time(double t);

}  // namespace spring_workbench::ros_common
