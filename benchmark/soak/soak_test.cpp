#include "benchmark/soak/soak.h"

#include <gtest/gtest.h>

#include <sstream>

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
  EXPECT_EQ(one.refused, 0);
  EXPECT_GT(one.largest_energy, 0.0);
}

}  // namespace
}  // namespace spring_workbench::benchmark
