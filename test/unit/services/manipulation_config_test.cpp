#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "spring_workbench/ManipulationConfig.h"
#include "spring_workbench/simulation/settings.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::services::manipulation_config_test {
namespace {

simulation::SettingDescription setting(const std::string& key) {
  const std::vector<simulation::SettingDescription> all = simulation::setting_descriptions();
  return *std::find_if(all.begin(), all.end(), [&](const auto& description) { return description.key == key; });
}

/// What cfg/Manipulation.cfg repeats. Of damping it is the range of the coefficients, as it may be either.
TEST(ManipulationConfig, RangesAndDefaultsAreThoseOfTheSettings) {
  using Config = ManipulationConfig;
  struct Row {
    double Config::*value;
    std::string range, value_at_start;
  };
  const std::vector<Row> rows = {
      {&Config::stretch_stiffness, "fork.stiffness.stretch", "fork.stiffness.stretch"},
      {&Config::bend_stiffness, "fork.stiffness.bend", "fork.stiffness.bend"},
      {&Config::torsion_stiffness, "fork.stiffness.torsion", "fork.stiffness.torsion"},
      {&Config::stretch_damping, "fork.damping_coefficient.stretch", "fork.damping.stretch"},
      {&Config::bend_damping, "fork.damping_coefficient.bend", "fork.damping.bend"},
      {&Config::torsion_damping, "fork.damping_coefficient.torsion", "fork.damping.torsion"},
      {&Config::step, "step", "step"},
  };
  for (const Row& row : rows) {
    const double least = Config::__getMin__().*row.value, most = Config::__getMax__().*row.value;
    EXPECT_EQ(validation::between(least, most).text(), setting(row.range).allowed) << row.range;
    const double at_start = Config::__getDefault__().*row.value;
    EXPECT_EQ(validation::number_text(at_start), setting(row.value_at_start).default_value) << row.value_at_start;
  }
  const Config& start = Config::__getDefault__();
  EXPECT_EQ(start.integrator, setting("integrator").default_value);
  for (const auto& [on, key] : {std::pair(start.stretch, "fork.dofs.stretch"),
                                {start.bend, "fork.dofs.bend"},
                                {start.torsion, "fork.dofs.torsion"}}) {
    EXPECT_EQ(on ? "true" : "false", setting(key).default_value) << key;
  }
}

}  // namespace
}  // namespace spring_workbench::services::manipulation_config_test
