#pragma once

namespace spring_workbench::hand_input {

/// The current moment on two clocks [s].
struct LocalTime {
  double loop = 0.0;      ///< clock of the loop: the steady clock or, under use_sim_time, simulated time
  double attended = 0.0;  ///< time that this process has spent running, by the steady clock: each reading adds at most
                          ///< 10 ms, so that messages that only wait, because a busy machine has stopped the process,
                          ///< do not count as missing
};

}  // namespace spring_workbench::hand_input
