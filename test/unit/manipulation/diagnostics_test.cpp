#include "spring_workbench/ros/manipulation/diagnostics.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/StepReport.h"

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

/// Samples that all come after a dropout: the hand never moves.
TEST(ManipulationDiagnostics, TellThatSamplesComeFartherApartThanADropout) {
  ManipulationDiagnostics diagnostics("node", 0.5);
  std::vector<TrackerInput> styluses(1);
  styluses[0].hand.stream.samples = styluses[0].hand.gate.accepted = 100;
  styluses[0].hand.gate.newest_dropout = 0.625;
  const std::pair<std::size_t, std::string> cases[] = {
      {1, "dropouts: 1 (1 since the start)"},
      {99,
       "samples come 0.625 s apart, more than dropout_after = 0.5 s: each gap counts as a dropout, so the hand "
       "does not move; increase dropout_after"}};
  for (const auto& [dropouts, message] : cases) {
    styluses[0].hand.gate.dropouts = dropouts;
    const diagnostic_msgs::DiagnosticStatus status = diagnostics.report(styluses, {}, 0.0).front();
    EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
    EXPECT_EQ(status.message, message);
  }
}

/// Every counter of ~steps, under its name there; which are counters, the message itself says: all that are integers.
TEST(ManipulationDiagnostics, HaveEveryCounterOfSteps) {
  ManipulationDiagnostics diagnostics("node", 0.5);
  const auto values = diagnostics.report(std::vector<TrackerInput>(1), LoopStatistics(), 0.0).back().values;
  std::set<std::string> keys;
  for (const diagnostic_msgs::KeyValue& value : values) keys.insert(value.key);
  const std::string definition = ros::message_traits::definition<StepReport>();
  const std::string own = definition.substr(0, definition.find("===="));  // without those of the types that it uses
  const std::regex counter(R"((?:^|\n)u?int\d+ (\w+))");
  std::size_t counters = 0;
  for (std::sregex_iterator field(own.begin(), own.end(), counter), end; field != end; ++field, ++counters)
    EXPECT_EQ(keys.count((*field)[1]), 1u) << (*field)[1];
  EXPECT_GE(counters, 9u);
  EXPECT_EQ(keys.count("time_lost [s]"), 1u);
}

/// They count over the whole run: a report of one cycle adds to each of them.
TEST(ManipulationDiagnostics, CountOverTheWholeRun) {
  LoopStatistics loop;
  simulation::AdvanceReport cycle;
  cycle.steps = 1;
  cycle.substeps = 2;
  cycle.stops = 3;
  cycle.steps_fallback = 4;
  cycle.steps_blocked = 5;
  cycle.steps_unsolved = 6;
  cycle.steps_rejected = 7;
  cycle.integrations_without_bound = 8;
  cycle.collision_queries = 9;
  for (int k = 0; k < 2; ++k) loop.advance.add(cycle);
  std::map<std::string, std::string> said;
  ManipulationDiagnostics diagnostics("node", 0.5);
  const auto values = diagnostics.report(std::vector<TrackerInput>(1), loop, 0.0).back().values;
  for (const diagnostic_msgs::KeyValue& value : values) said[value.key] = value.value;
  int expected = 0;
  for (const char* key : {"steps", "substeps", "stops", "steps_fallback", "steps_blocked", "steps_unsolved",
                          "steps_rejected", "integrations_without_bound", "collision_queries"}) {
    EXPECT_EQ(said[key], std::to_string(expected += 2)) << key;
  }
}

}  // namespace
}  // namespace spring_workbench::manipulation::diagnostics_test
