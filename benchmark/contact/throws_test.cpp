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

// Of boxes, where there are more than two. Meshes and cylinders go deeper; benchmark/contact/README.md.
TEST(LooseThrows, ALooseThinWallIsNotGoneThrough) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    if (seed % 4 > 1) continue;
    const ThrowResult result = run(Throw{scene::ContactMode::dynamic, seed, true, true});
    EXPECT_FALSE(result.passed_through) << seed;
    EXPECT_LT(result.depth, 1e-4) << seed;
    EXPECT_LT(result.energy_gained, 2e-3) << seed;
  }
}

TEST(LooseThrows, AmongOthersNothingGainsEnergy) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    EXPECT_LT(run(Throw{scene::ContactMode::dynamic, seed, true, true}).energy_gained, 1e-5) << seed;
  }
}

// What goes deep among several bodies is counted, and what does not is not.
TEST(LooseThrows, WhatGoesDeepIsCounted) {
  int deep = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const ThrowResult result = run({scene::ContactMode::dynamic, seed, true, true});
    if (result.depth > 1e-3) {
      ++deep;
      EXPECT_GT(result.steps_unsolved, 0) << seed;
    }
    if (seed % 4 < 2) {
      EXPECT_EQ(result.steps_unsolved, 0) << seed;
    }
  }
  EXPECT_GT(deep, 0);
}

INSTANTIATE_TEST_SUITE_P(Modes, Throws, ::testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& tested) {
                           return tested.param == scene::ContactMode::stop ? "stop" : "dynamic";
                         });

}  // namespace
}  // namespace spring_workbench::benchmark::throws_test
