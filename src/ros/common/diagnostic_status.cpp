#include "spring_workbench/ros/common/diagnostic_status.h"

namespace spring_workbench::ros_common {

using diagnostic_msgs::DiagnosticStatus;

DiagnosticStatusBuilder::DiagnosticStatusBuilder(const std::string& name, const std::string& hardware) {
  status_.level = DiagnosticStatus::OK;
  status_.name = name;
  status_.message = "ok";
  status_.hardware_id = hardware;
}

DiagnosticStatusBuilder& DiagnosticStatusBuilder::raise(int8_t level, const std::string& reason) {
  if (level > status_.level) {
    status_.level = level;
    status_.message = reason;
  }
  return *this;
}

void add_stream(const motion::StreamFigures& stream, DiagnosticStatusBuilder& status) {
  status.add("samples", stream.samples)
      .add("rate [Hz]", stream.interval > 0.0 ? 1.0 / stream.interval : 0.0)
      .add("jitter of stamps [s]", stream.stamp_jitter)
      .add("jitter of receipt [s]", stream.receipt_jitter)
      .add("age of newest sample on arrival [s]", stream.age)
      .add("longest gap [s]", stream.longest_gap);
}

}  // namespace spring_workbench::ros_common
