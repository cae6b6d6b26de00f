#include "benchmark/contact/drops.h"

#include <gtest/gtest.h>

namespace spring_workbench::benchmark::drops_test {
namespace {

// Some of the drops that `contact_trials drops 1000` runs.
class Drops : public ::testing::TestWithParam<scene::ContactMode> {};

TEST_P(Drops, WithoutRestitutionNothingLeavesTheBench) {
  for (unsigned seed = 0; seed < 48; ++seed) {
    const DropResult result = run(Drop{GetParam(), seed});
    EXPECT_GT(result.impact_speed, 0.3) << seed;
    // If it is more tilted, its corners land one after the other, and it tumbles.
    EXPECT_LT(result.leaving, result.tilt < 0.03 ? 0.01 : 0.1) << seed;
    EXPECT_LT(result.energy_gained, 1e-3) << seed;
    EXPECT_LT(result.depth, 3e-4) << seed;
    EXPECT_LT(result.rest_gap, 3e-5) << seed;
    EXPECT_EQ(result.steps_blocked, 0) << seed;
  }
}

// Also in short steps, in which one corner touches long before the others.
TEST(AlmostFlush, LandsWithAllCornersAtOnce) {
  int almost_flush = 0;
  for (unsigned seed = 48; seed < 360; ++seed) {
    const DropResult result = run(Drop{scene::ContactMode::stop, seed});
    if (result.tilt >= 0.03) continue;
    EXPECT_LT(result.leaving, 0.01) << seed;
    ++almost_flush;
  }
  EXPECT_GT(almost_flush, 100);
}

INSTANTIATE_TEST_SUITE_P(Modes, Drops, ::testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& tested) {
                           return tested.param == scene::ContactMode::stop ? "stop" : "dynamic";
                         });

}  // namespace
}  // namespace spring_workbench::benchmark::drops_test
