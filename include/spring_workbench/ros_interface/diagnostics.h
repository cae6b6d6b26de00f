#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <string>
#include <vector>

#include "spring_workbench/ros_interface/stylus_input.h"
#include "spring_workbench/tracker/reengagement.h"

namespace spring_workbench {

/// What the physics loop did so far.
struct LoopStatistics {
  std::size_t cycles = 0;
  std::size_t deadlines_missed = 0;
  std::size_t guards_tripped = 0;  ///< steps refused by the simulation
  std::size_t leaps = 0;           ///< times the simulation was started anew because time leapt
  double longest_cycle = 0.0;      ///< wall time in the simulation [s]
};

/// One status of /diagnostics, built field by field.
class DiagnosticStatusBuilder {
 public:
  DiagnosticStatusBuilder(const std::string& name, const std::string& hardware);
  DiagnosticStatusBuilder& add(const std::string& key, const std::string& value);
  DiagnosticStatusBuilder& add(const std::string& key, double value);
  DiagnosticStatusBuilder& add(const std::string& key, std::size_t value);
  /// Raises the level (OK, WARN, ERROR, STALE) with a reason; a lower one than the present changes nothing.
  DiagnosticStatusBuilder& raise(int8_t level, const std::string& reason);
  const diagnostic_msgs::DiagnosticStatus& status() const { return status_; }

 private:
  diagnostic_msgs::DiagnosticStatus status_;
};

/// How evenly a station's samples come and what its gate met, as fields of a status.
void add_stream(const StreamFigures& stream, const GateCounts& gate, DiagnosticStatusBuilder& status);

/// Why no sample of the stylus is used, and what to do about it: one line, empty where samples are used.
/// `senders`: the nodes that the master says publish /tf, this one left out.
std::string hint_for_silence(const InputStatistics& input, const std::vector<std::string>& senders,
                             const std::string& stylus_frame);

/// What came of one stylus, and what became of the hand.
struct TrackerInput {
  InputStatistics input;
  ReengagementCounts hand;
  std::string hint;  ///< of `hint_for_silence`
};

/// Watches the counters and says once a second how tracker input and physics loop are doing: WARN when something went
/// wrong since the last time, STALE when no sample came at all. A second stylus is told of once something came of it.
class ManipulationDiagnostics {
 public:
  /// `name`: of the node. `dropout_after` [s]: silence of the tracker longer than this is told.
  ManipulationDiagnostics(const std::string& name, double dropout_after) : name_(name), dropout_after_(dropout_after) {}

  /// `now` [s]: local time.
  std::vector<diagnostic_msgs::DiagnosticStatus> report(const TrackerInput& first, const TrackerInput& second,
                                                        const LoopStatistics& loop, double now);

 private:
  diagnostic_msgs::DiagnosticStatus report_input(const std::string& what, const TrackerInput& tracker,
                                                 const TrackerInput& last, double now) const;
  diagnostic_msgs::DiagnosticStatus report_loop(const LoopStatistics& loop) const;

  std::string name_;
  double dropout_after_;
  TrackerInput last_first_, last_second_;
  LoopStatistics last_loop_;
};

}  // namespace spring_workbench
