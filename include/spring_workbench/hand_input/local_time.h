#pragma once

namespace spring_workbench::hand_input {

/// One moment on two clocks [s].
struct LocalTime {
  double loop = 0.0;      ///< of the loop: steady, or simulated
  double attended = 0.0;  ///< of the steady clock, the time in which this process ran: it grows by at most 10 ms from
                          ///< one look to the next, so that messages that wait while a busy machine stops the process
                          ///< are not taken for messages that do not come
};

}  // namespace spring_workbench::hand_input
