#include "spring_workbench/ros/manipulation/diagnostics.h"

#include <gtest/gtest.h>

namespace spring_workbench::manipulation::diagnostics_test {
namespace {

/// Counters are reported each time; the level is raised if they have increased since the last report.
TEST(ManipulationDiagnostics, TellThatTheLoopWaitsForMessages) {
  ManipulationDiagnostics diagnostics("node", 0.5);
  LoopStatistics loop;
  const std::vector<TrackerInput> none(1);
  for (const std::size_t waits : {0u, 0u, 3u, 3u, 4u}) {
    const bool more = waits > loop.waits;
    loop.waits = waits;
    const diagnostic_msgs::DiagnosticStatus status = diagnostics.report(none, loop, 0.0).back();
    EXPECT_EQ(status.level, more ? diagnostic_msgs::DiagnosticStatus::WARN : diagnostic_msgs::DiagnosticStatus::OK);
    std::string said;
    for (const diagnostic_msgs::KeyValue& value : status.values) {
      if (value.key == "waits for unsent messages") said = value.value;
    }
    EXPECT_EQ(said, std::to_string(waits));
  }
}

}  // namespace
}  // namespace spring_workbench::manipulation::diagnostics_test
