#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <string>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/ros/common/diagnostic_status.h"
#include "spring_workbench/ros/manipulation/stylus_input.h"

namespace spring_workbench::manipulation {

/// Statistics of the physics loop since its start.
struct LoopStatistics {
  std::size_t cycles = 0;
  std::size_t deadlines_missed = 0;   ///< by the cycle or by its messages
  std::size_t waits = 0;              ///< for states whose messages are unsent (Outbox)
  simulation::AdvanceReport advance;  ///< all steps together
  double time_skipped = 0.0;          ///< because the process was stopped or time jumped [s]
  std::size_t cycles_behind = 0;      ///< in which simulated time was slower than the hands'
  double longest_cycle = 0.0;         ///< wall time in the simulation [s]
  double master_silence = 0.0;        ///< since the ROS master last answered [s]
  std::string checkpoint_error;       ///< see Checkpoint::file_error()
  int realtime_priority = 0;          ///< of the loop's thread, as the system gave it
  double prediction_error = 0.0;      ///< see LookAhead::position_error_99() [m]
};

/// Input of one stylus, and what the simulation made of it.
struct TrackerInput {
  InputStatistics input;
  live::HandStatistics hand;
  std::string hint;  ///< of `hint_for_silence`
};

/// Why no sample of the stylus is used, and what to do about it: one line, empty where samples are used.
/// `senders`: the other nodes that, according to the master, publish /tf.
std::string hint_for_silence(const TrackerInput& tracker, const std::vector<std::string>& senders,
                             const std::string& stylus_frame);

/// Reports the state of tracker input and physics loop once a second, from their counters: WARN if something went wrong
/// since the last report, STALE without any sample. A further stylus is reported once it has sent something.
class ManipulationDiagnostics {
 public:
  /// `name`: of the node. `dropout_after` [s]: a longer silence of the tracker is reported.
  ManipulationDiagnostics(const std::string& name, double dropout_after) : name_(name), dropout_after_(dropout_after) {}

  /// `styluses`: of each, always as many; `now` [s]: local time.
  std::vector<diagnostic_msgs::DiagnosticStatus> report(const std::vector<TrackerInput>& styluses,
                                                        const LoopStatistics& loop, double now);

 private:
  diagnostic_msgs::DiagnosticStatus report_input(const std::string& what, const TrackerInput& tracker,
                                                 const TrackerInput& last, double now) const;
  diagnostic_msgs::DiagnosticStatus report_loop(const LoopStatistics& loop) const;

  std::string name_;
  double dropout_after_;
  std::vector<TrackerInput> last_;
  LoopStatistics last_loop_;
};

}  // namespace spring_workbench::manipulation
