#pragma once

namespace spring_workbench::hand_input {

/// The current moment on two clocks of the caller [s]. InputFilter uses them to tell a silent hand from a late message.
struct LocalTime {
  double loop = 0.0;  ///< clock of the caller's loop: a steady clock or, under use_sim_time, simulated time
  /// Time on a steady clock during which the process ran. Each reading of the clock advances it by at most 10 ms. So
  /// a process that was stopped does not take a hand for silent while its messages are queued.
  double running = 0.0;
};

}  // namespace spring_workbench::hand_input
