#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <string>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/ros/common/diagnostic_status.h"
#include "spring_workbench/ros/manipulation/stylus_input.h"

namespace spring_workbench::manipulation {

/// What the physics loop did so far.
struct LoopStatistics {
  std::size_t cycles = 0;
  std::size_t deadlines_missed = 0;   ///< by the cycle or by its messages
  std::size_t waits = 0;              ///< for states whose messages are unsent (Outbox)
  simulation::AdvanceReport advance;  ///< all steps together
  double left_out = 0.0;              ///< of time, since the process stood or time leapt [s]
  std::size_t cycles_behind = 0;      ///< in which simulated time was slower than the hands'
  double longest_cycle = 0.0;         ///< wall time in the simulation [s]
  double master_silence = 0.0;        ///< since the ROS master last answered [s]
  std::string checkpoint_error;       ///< see Checkpoint::file_error()
  int realtime_priority = 0;          ///< of the loop's thread, as the system gave it
  double prediction_error = 0.0;      ///< see LookAhead::position_error_99() [m]
};

/// What came of one stylus, and what became of the hand.
struct TrackerInput {
  InputStatistics input;
  live::HandStatistics hand;
  std::string hint;  ///< of `hint_for_silence`
};

/// Why no sample of the stylus is used, and what to do about it: one line, empty where samples are used.
/// `senders`: the nodes that the master says publish /tf, this one left out.
std::string hint_for_silence(const TrackerInput& tracker, const std::vector<std::string>& senders,
                             const std::string& stylus_frame);

/// Watches the counters and says once a second how tracker input and physics loop are doing: WARN when something went
/// wrong since the last time, STALE when no sample came at all. A further stylus is told of once something came of it.
class ManipulationDiagnostics {
 public:
  /// `name`: of the node. `dropout_after` [s]: silence of the tracker longer than this is told.
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
