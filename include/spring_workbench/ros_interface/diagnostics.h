#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <string>
#include <vector>

#include "spring_workbench/ros_interface/stylus_input.h"

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

/// Watches the counters and says once a second how tracker input and physics loop are doing: WARN when something went
/// wrong since the last time, STALE when no sample came at all.
class ManipulationDiagnostics {
 public:
  /// `name`: of the node. `dropout_after` [s]: silence of the tracker longer than this is told.
  ManipulationDiagnostics(const std::string& name, double dropout_after) : name_(name), dropout_after_(dropout_after) {}

  /// `now` [s]: local time.
  std::vector<diagnostic_msgs::DiagnosticStatus> report(const InputStatistics& input, const LoopStatistics& loop,
                                                        double now);

 private:
  diagnostic_msgs::DiagnosticStatus report_input(const InputStatistics& input, double now) const;
  diagnostic_msgs::DiagnosticStatus report_loop(const LoopStatistics& loop) const;

  std::string name_;
  double dropout_after_;
  InputStatistics last_input_;
  LoopStatistics last_loop_;
};

}  // namespace spring_workbench
