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
  std::size_t deadlines_missed = 0;   ///< cycles that, or whose messages, were late
  std::size_t waits = 0;              ///< waits of the loop because too many states were unsent (Outbox)
  simulation::AdvanceReport advance;  ///< total over all steps
  double time_skipped = 0.0;          ///< time skipped because the process was stopped or time jumped [s]
  std::size_t cycles_behind = 0;      ///< cycles in which simulated time was slower than the hands' time
  double longest_cycle = 0.0;         ///< longest wall time of a cycle's simulation [s]
  double master_silence = 0.0;        ///< time since the ROS master's last reply [s]
  std::string checkpoint_error;       ///< see Checkpoint::file_error()
  int realtime_priority = 0;          ///< priority of the loop's thread that the system granted
  double prediction_error = 0.0;      ///< see LookAhead::position_error_99() [m]
};

/// Input of one stylus, and how the simulation used it.
struct TrackerInput {
  InputStatistics input;
  live::HandStatistics hand;
  std::string hint;  ///< result of hint_for_silence()
};

/// Why no sample of the stylus is used, and what to do about it, in one line; empty if samples are used. `senders`: the
/// other nodes that publish /tf according to the master.
std::string hint_for_silence(const TrackerInput& tracker, const std::vector<std::string>& senders,
                             const std::string& stylus_frame);

/// Reports the state of tracker input and physics loop once a second, from their counters: WARN if something went wrong
/// since the last report, STALE if there is no sample. A second or later stylus is reported once it has sent something.
class ManipulationDiagnostics {
 public:
  /// `name`: name of the node. `dropout_after` [s]: a longer silence of the tracker is reported.
  ManipulationDiagnostics(const std::string& name, double dropout_after) : name_(name), dropout_after_(dropout_after) {}

  /// `styluses`: input of each stylus, the same number in every call; `now`: local time [s].
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
