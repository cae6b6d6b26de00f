#include "benchmark/soak/soak.h"

#include <gtest/gtest.h>

#include <sstream>

#include "benchmark/soak/day.h"
#include "spring_workbench/config/yaml_fields.h"
#include "support/paths.h"

namespace spring_workbench::benchmark {
namespace {

SoakResult short_soak(unsigned seed) {
  SoakOptions options;
  options.scene = test_support::checkout("scenes/mini_world.urdf");
  simulation::apply_settings(config::load_yaml_file(test_support::checkout("config/assembly.yaml")), "assembly.yaml",
                             options.settings);
  options.steps = 1000;
  options.seed = seed;
  std::ostringstream lines;
  return run_soak(options, lines);
}

TEST(Soak, TheSameSeedGivesTheSameBitsAndAnotherOneDoesNot) {
  const SoakResult one = short_soak(1), again = short_soak(1), other = short_soak(2);
  EXPECT_EQ(one.hash, again.hash);
  EXPECT_NE(one.hash, other.hash);
  EXPECT_GE(one.steps, 1000);
  EXPECT_TRUE(one.finite);
  EXPECT_EQ(one.rejected, 0);
  EXPECT_GT(one.largest_energy, 0.0);
}

/// Six minutes of a live session with faults, in which nothing is lost, and its replay.
TEST(Day, WithFaultsOfEachKindNothingIsLostAndTheHashIsTheReplays) {
  DayOptions options;
  options.scene = test_support::checkout("scenes/mini_world.urdf");
  options.motions = {test_support::checkout("config/mini_world_demo.yaml")};
  options.hours = 0.1;
  std::ostringstream lines;
  const DayResult day = run_day(options, lines);
  EXPECT_TRUE(day.finite);
  EXPECT_EQ(day.hash, day.replay_hash);
  EXPECT_EQ(day.mismatches, 0u);
  EXPECT_EQ(day.lost_states, 0u);
  EXPECT_LE(day.restarts, day.lives);
  EXPECT_GE(day.lives, 2u);
  EXPECT_GE(day.faults.size(), 6u);
  EXPECT_GT(day.changes, 20u);
  EXPECT_GT(day.comparisons, 200u);
  EXPECT_GT(day.held_ticks, day.ticks / 10);
}

}  // namespace
}  // namespace spring_workbench::benchmark
