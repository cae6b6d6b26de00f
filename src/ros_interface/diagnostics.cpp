#include "spring_workbench/ros_interface/diagnostics.h"

#include <sstream>

namespace spring_workbench {

using diagnostic_msgs::DiagnosticStatus;

DiagnosticStatusBuilder::DiagnosticStatusBuilder(const std::string& name, const std::string& hardware) {
  status_.level = DiagnosticStatus::OK;
  status_.name = name;
  status_.message = "ok";
  status_.hardware_id = hardware;
}

DiagnosticStatusBuilder& DiagnosticStatusBuilder::add(const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue entry;
  entry.key = key;
  entry.value = value;
  status_.values.push_back(entry);
  return *this;
}

DiagnosticStatusBuilder& DiagnosticStatusBuilder::add(const std::string& key, double value) {
  std::ostringstream text;
  text << value;
  return add(key, text.str());
}

DiagnosticStatusBuilder& DiagnosticStatusBuilder::add(const std::string& key, std::size_t value) {
  return add(key, std::to_string(value));
}

DiagnosticStatusBuilder& DiagnosticStatusBuilder::raise(int8_t level, const std::string& reason) {
  if (level > status_.level) {
    status_.level = level;
    status_.message = reason;
  }
  return *this;
}

std::vector<DiagnosticStatus> ManipulationDiagnostics::report(const InputStatistics& input, const LoopStatistics& loop,
                                                              double now) {
  std::vector<DiagnosticStatus> result{report_input(input, now), report_loop(loop)};
  last_input_ = input;
  last_loop_ = loop;
  return result;
}

DiagnosticStatus ManipulationDiagnostics::report_input(const InputStatistics& input, double now) const {
  DiagnosticStatusBuilder status(name_ + ": tracker input", "tracker");
  status.add("samples", input.samples)
      .add("rate [Hz]", input.interval > 0.0 ? 1.0 / input.interval : 0.0)
      .add("age of newest sample when it came [s]", input.age)
      .add("dropouts", input.dropouts)
      .add("jumps back in time", input.restarts);
  bool more_left_out = false;
  for (const auto& [reason, count] : input.left_out) {
    status.add("left out: " + reason, count);
    const auto before = last_input_.left_out.find(reason);
    more_left_out |= before == last_input_.left_out.end() || before->second < count;
  }
  if (input.samples == 0) return status.raise(DiagnosticStatus::STALE, "no sample yet").status();
  const double silence = now - input.newest_arrival;
  status.add("time since newest sample [s]", silence);
  if (silence > dropout_after_) status.raise(DiagnosticStatus::WARN, "no samples: the hand is held at rest");
  if (input.dropouts > last_input_.dropouts) status.raise(DiagnosticStatus::WARN, "dropouts");
  if (more_left_out) status.raise(DiagnosticStatus::WARN, "samples left out");
  return status.status();
}

DiagnosticStatus ManipulationDiagnostics::report_loop(const LoopStatistics& loop) const {
  DiagnosticStatusBuilder status(name_ + ": physics loop", "simulation");
  status.add("cycles", loop.cycles)
      .add("deadlines missed", loop.deadlines_missed)
      .add("guards tripped", loop.guards_tripped)
      .add("leaps of time", loop.leaps)
      .add("longest cycle [s]", loop.longest_cycle);
  if (loop.guards_tripped > last_loop_.guards_tripped) {
    status.raise(DiagnosticStatus::ERROR, "steps refused: they would not have been finite or bounded");
  }
  if (loop.deadlines_missed > last_loop_.deadlines_missed) status.raise(DiagnosticStatus::WARN, "deadlines missed");
  if (loop.leaps > last_loop_.leaps) status.raise(DiagnosticStatus::WARN, "time leapt");
  return status.status();
}

}  // namespace spring_workbench
