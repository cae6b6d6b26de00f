#pragma once

#include <ros/time.h>

namespace spring_workbench {

/// Local time [s] that intervals are measured with: ROS time under `use_sim_time`, else the steady clock.
double loop_time();

/// One moment by two clocks [s].
struct LocalTime {
  double loop = 0.0;      ///< `loop_time`
  double attended = 0.0;  ///< of the steady clock, the time in which this process ran: it grows by at most 10 ms from
                          ///< one look to the next, so that messages that wait while a busy machine stops the process
                          ///< are not taken for messages that do not come
};
LocalTime local_time();

/// Sleeps until `loop_time()` is `t`. Under `use_sim_time` it also returns when the clock goes back, when it stood for
/// 0.1 s, and on shutdown.
void sleep_until_loop_time(double t);

}  // namespace spring_workbench
