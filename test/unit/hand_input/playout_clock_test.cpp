#include "spring_workbench/hand_input/playout_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace spring_workbench::hand_input {
namespace {

constexpr double dropout_after = 0.5;

LocalTime both(double t) { return {t, t}; }

TEST(PlayoutClock, NothingToDoBeforeTheFirstSample) {
  EXPECT_EQ(PlayoutClock(dropout_after).target(both(123.0)), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(PlayoutClock(dropout_after, true).target(both(123.0)), -std::numeric_limits<double>::infinity());
}

TEST(PlayoutClock, RegularSamplesAreFollowedOneIntervalBehind) {
  PlayoutClock clock(dropout_after);
  const double interval = 0.02, latency = 0.0137, offset = 1000.0;  // of the tracker's clock
  for (int k = 0; k < 500; ++k) {
    const double t = interval * k, arrival = t + latency - offset;
    clock.sample(t, both(arrival));
    for (const double part : {0.0, 0.3, 0.99}) {
      const double expected = k == 0 ? 0.0 : t - interval + part * interval;
      EXPECT_NEAR(clock.target(both(arrival + part * interval)), expected, 1e-9);
    }
  }
}

TEST(PlayoutClock, NeverPassesTheNewestSampleWhileSamplesCome) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> interval(0.001, 0.2), delay(0.0, 0.2), wait(0.0, dropout_after);
  for (int run = 0; run < 200; ++run) {
    PlayoutClock clock(dropout_after);
    double t = 0.0, arrival = 0.0;
    for (int k = 0; k < 50; ++k) {
      t += interval(random);
      arrival = std::max(arrival, t + delay(random));
      clock.sample(t, both(arrival));
      EXPECT_LE(clock.target(both(arrival + wait(random))), t);
    }
  }
}

TEST(PlayoutClock, InSimulatedTimeTheSampleBeforeTheNewestIsTheEndWhateverTheMoment) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> interval(0.001, 0.2), late(0.0, 10.0), quick(0.0, 0.19);
  PlayoutClock clock(dropout_after, true);
  double t = 0.0, before = 0.0, wall = 0.0;
  clock.sample(t, {100.0, wall});
  for (int k = 0; k < 500; ++k) {
    before = t;
    t += interval(random);
    wall += quick(random);
    clock.sample(t, {100.0 + t, wall});
    EXPECT_EQ(clock.target({100.0 + t + late(random), wall + quick(random)}), before);
  }
  EXPECT_GT(clock.target({100.0 + t + 2.0, wall + 1.0}), t + 1.5);  // but silence is silence
}

TEST(PlayoutClock, GoesOnWithTheLocalClockAfterADropout) {
  PlayoutClock clock(dropout_after);
  clock.sample(0.00, both(10.00));
  clock.sample(0.02, both(10.02));
  const double first = clock.target(both(10.02 + dropout_after + 0.001));
  EXPECT_GT(first, 0.02);
  EXPECT_NEAR(clock.target(both(10.02 + dropout_after + 2.001)) - first, 2.0, 1e-12);
}

TEST(PlayoutClock, ALocalClockThatGoesBackStandsStill) {
  PlayoutClock clock(dropout_after);
  clock.sample(0.00, both(10.00));
  clock.sample(0.02, both(10.02));
  EXPECT_EQ(clock.target(both(3.0)), clock.target(both(10.02)));
}

/// One interval in ten times as many is a tenth of the usual one; 0.2 s of attended time are silence.
TEST(PlayoutClock, SmoothsTheIntervalAndWaitsForSilence) {
  PlayoutClock clock(dropout_after);
  clock.sample(0.00, both(10.00));
  clock.sample(0.02, both(10.02));
  clock.sample(0.05, both(10.05));
  EXPECT_NEAR(clock.target(both(10.05)), 0.05 - (0.02 + 0.1 * 0.01), 1e-12);
  for (const double attended : {0.19, 0.21}) {
    PlayoutClock simulated(dropout_after, true);
    simulated.sample(0.00, {10.00, 0.0});
    simulated.sample(0.02, {10.02, 0.0});
    const double target = simulated.target({20.0, attended});
    EXPECT_EQ(target > 1.0, attended > 0.2) << attended;
  }
}

TEST(PlayoutClock, ClearForgetsAll) {
  PlayoutClock clock(dropout_after);
  clock.sample(0.00, both(10.00));
  clock.clear();
  EXPECT_FALSE(std::isfinite(clock.target(both(11.0))));
}

}  // namespace
}  // namespace spring_workbench::hand_input
