#include "benchmark/contact/throws.h"

#include <gtest/gtest.h>

namespace spring_workbench::benchmark::throws_test {
namespace {

// Some of the throws that `contact_trials throws 1000` runs.
class Throws : public ::testing::TestWithParam<scene::ContactMode> {};

TEST_P(Throws, AThinFixedWallStopsWhatIsThrownAtIt) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const ThrowResult result = run(Throw{GetParam(), seed});
    EXPECT_FALSE(result.passed_through) << seed;
    EXPECT_LT(result.depth, 1e-4) << seed;
    EXPECT_LT(result.energy_gained, 1e-5) << seed;
    EXPECT_EQ(result.steps_blocked, 0) << seed;
  }
}

TEST(LooseThrows, NothingGoesDeepOrGainsEnergy) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const ThrowResult result = run(Throw{scene::ContactMode::dynamic, seed, true});
    EXPECT_FALSE(result.passed_through) << seed;
    EXPECT_LT(result.depth, 1e-4) << seed;
    EXPECT_LT(result.energy_gained, 1e-5) << seed;
    EXPECT_LT(result.momentum_changed, 1e-10) << seed;
    EXPECT_EQ(result.steps_blocked + result.steps_unsolved, 0) << seed;
  }
}

TEST(LooseThrows, AmongOthersNothingGoesDeepOrGainsEnergy) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const ThrowResult result = run(Throw{scene::ContactMode::dynamic, seed, true, true});
    EXPECT_FALSE(result.passed_through) << seed;
    EXPECT_LT(result.depth, 1e-4) << seed;
    EXPECT_LT(result.energy_gained, 1e-5) << seed;
    EXPECT_EQ(result.steps_blocked + result.steps_unsolved, 0) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, Throws, ::testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& tested) {
                           return tested.param == scene::ContactMode::stop ? "stop" : "dynamic";
                         });

}  // namespace
}  // namespace spring_workbench::benchmark::throws_test
