#pragma once

namespace spring_workbench::hand_input {

/// The current moment on two clocks [s].
struct LocalTime {
  double loop = 0.0;  ///< clock of the loop: the steady clock or, under use_sim_time, simulated time
  /// Steady-clock time during which the process ran: each reading advances it by at most 10 ms, so that a process that
  /// was stopped or starved does not take messages that were queued meanwhile for lost ones.
  double attended = 0.0;
};

}  // namespace spring_workbench::hand_input
