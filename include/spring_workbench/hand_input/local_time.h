#pragma once

namespace spring_workbench::hand_input {

/// The current moment on two clocks [s].
struct LocalTime {
  double loop = 0.0;      ///< clock of the loop: the steady clock or, under use_sim_time, simulated time
  double attended = 0.0;  ///< steady-clock time, of which each reading counts at most 10 ms since the one before:
                          ///< while the process was stopped or starved, its messages queued up, and must not be
                          ///< taken for missing
};

}  // namespace spring_workbench::hand_input
