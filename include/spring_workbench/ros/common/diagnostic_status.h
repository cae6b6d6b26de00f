#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <sstream>
#include <string>

#include "spring_workbench/motion/stream_monitor.h"

namespace spring_workbench::ros_common {

/// One status of /diagnostics, built field by field.
class DiagnosticStatusBuilder {
 public:
  DiagnosticStatusBuilder(const std::string& name, const std::string& hardware);
  template <typename Value>
  DiagnosticStatusBuilder& add(const std::string& key, const Value& value) {
    std::ostringstream text;
    text << value;
    status_.values.emplace_back();
    status_.values.back().key = key;
    status_.values.back().value = text.str();
    return *this;
  }
  /// Raises the level (OK, WARN, ERROR, STALE) with a reason. A level below the current one changes nothing.
  DiagnosticStatusBuilder& raise(int8_t level, const std::string& reason);
  DiagnosticStatusBuilder& warn(const std::string& reason) {
    return raise(diagnostic_msgs::DiagnosticStatus::WARN, reason);
  }
  const diagnostic_msgs::DiagnosticStatus& status() const { return status_; }

 private:
  diagnostic_msgs::DiagnosticStatus status_;
};

/// How far a count has risen, for the message of a status: "dropouts: 2 (7 since the start)".
template <typename Count>
std::string increase(const std::string& what, Count before, Count now) {
  std::ostringstream text;
  text << what << ": " << now - before << " (" << now << " since the start)";
  return text.str();
}

/// Adds how evenly a station's samples arrive, as fields of a status.
void add_stream(const motion::StreamFigures& stream, DiagnosticStatusBuilder& status);

}  // namespace spring_workbench::ros_common
