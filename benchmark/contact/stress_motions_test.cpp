#include "benchmark/contact/stress_motions.h"

#include <gtest/gtest.h>

namespace spring_workbench::benchmark::stress_motions_test {
namespace {

// Some of the motions that `contact_trials record` runs.
class RodInRoom : public ::testing::TestWithParam<scene::ContactMode> {};

TEST_P(RodInRoom, GoesThroughNoWall) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const StressResult result = run(StressMotion{StressScene::rod_in_room, GetParam(), seed});
    EXPECT_FALSE(result.passed_through) << seed;
    EXPECT_LE(result.penetration, 1e-4) << seed;
    EXPECT_GT(result.steps, 0) << seed;
    EXPECT_EQ(result.steps_blocked, 0) << seed;
    EXPECT_EQ(result.rejected, 0) << seed;
  }
}

// A strongly bent fork that folds needs substeps of microseconds, whatever its damping ratio.
TEST(RodInRoom, IsNeverBlockedHoweverTheForkIsDampedOrFolds) {
  const auto check = [](unsigned seed, double damping_ratio) {
    const StressResult result =
        run(StressMotion{StressScene::rod_in_room, scene::ContactMode::stop, seed, damping_ratio});
    EXPECT_FALSE(result.passed_through) << seed << ' ' << damping_ratio;
    EXPECT_LE(result.penetration, 5e-5) << seed << ' ' << damping_ratio;
    EXPECT_EQ(result.steps_blocked, 0) << seed << ' ' << damping_ratio;
    EXPECT_EQ(result.time_lost, 0.0) << seed << ' ' << damping_ratio;
    EXPECT_EQ(result.rejected, 0) << seed << ' ' << damping_ratio;
  };
  for (const unsigned seed : {95u, 125u, 309u}) check(seed, 1.0);
  for (const double damping_ratio : {0.0, 0.1, 10.0}) {
    for (unsigned seed = 0; seed < 5; ++seed) check(seed, damping_ratio);
  }
}

// In seed 217, contacts of neighbouring triangles are merged, and the deepest one approaches.
TEST(RingOnRod, StaysOnTheRod) {
  for (const unsigned seed : {0u, 3u, 10u, 217u}) {
    const StressResult result = run(StressMotion{StressScene::ring_on_rod, scene::ContactMode::stop, seed});
    EXPECT_FALSE(result.passed_through) << seed;
    EXPECT_LE(result.penetration, 1e-4) << seed;
    EXPECT_EQ(result.steps_blocked, 0) << seed;
    EXPECT_EQ(result.rejected, 0) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, RodInRoom, ::testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& tested) {
                           return tested.param == scene::ContactMode::stop ? "stop" : "dynamic";
                         });

}  // namespace
}  // namespace spring_workbench::benchmark::stress_motions_test
