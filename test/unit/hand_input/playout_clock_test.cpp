#include "spring_workbench/hand_input/playout_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace spring_workbench::hand_input::playout_clock_test {
namespace {

constexpr double dropout_after = 0.5;
constexpr double infinity = std::numeric_limits<double>::infinity();

LocalTime both(double t) { return {t, t}; }

TEST(PlayoutClock, NothingIsKnownBeforeTheSecondSample) {
  PlayoutClock clock(dropout_after);
  EXPECT_EQ(clock.complete_until(both(123.0)), -infinity);
  EXPECT_EQ(clock.rests_until(both(123.0)), -infinity);
  clock.add_sample(1.0, both(123.0));
  EXPECT_EQ(clock.complete_until(both(123.1)), -infinity);
}

TEST(PlayoutClock, TheSampleBeforeTheNewestIsTheEndWhateverTheMoment) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> interval(0.001, 0.2), late(0.0, 10.0), quick(0.0, 0.19);
  PlayoutClock clock(dropout_after);
  double t = 0.0, before = 0.0, running = 0.0;
  clock.add_sample(t, {100.0, running});
  for (int k = 0; k < 500; ++k) {
    before = t;
    t += interval(random);
    running += quick(random);
    clock.add_sample(t, {100.0 + t, running});
    EXPECT_EQ(clock.complete_until({100.0 + t + late(random), running + quick(random)}), before);
  }
  EXPECT_EQ(clock.complete_until({100.0 + t + 2.0, running + 1.0}), infinity);  // but silence is silence
}

TEST(PlayoutClock, ButtonsHoldItBackWhileMessagesAboutThemCome) {
  PlayoutClock clock(dropout_after);
  for (const double t : {0.0, 0.02, 0.04}) clock.add_sample(t, both(10.0 + t));
  clock.confirm_buttons(0.01, both(10.03));
  EXPECT_EQ(clock.complete_until(both(10.05)), 0.01);
  EXPECT_EQ(clock.complete_until(both(10.25)), 0.02);
}

TEST(PlayoutClock, ASilentHandRestsOnByTheLocalClock) {
  PlayoutClock clock(dropout_after);
  clock.add_sample(0.00, both(10.00));
  clock.add_sample(0.02, both(10.02));
  EXPECT_EQ(clock.complete_until(both(10.02 + dropout_after - 0.001)), 0.0);
  EXPECT_EQ(clock.complete_until(both(10.02 + dropout_after + 0.001)), infinity);
  EXPECT_NEAR(clock.rests_until(both(10.02 + 2.0)), 2.0, 1e-12);
}

TEST(PlayoutClock, ALocalClockThatGoesBackStandsStill) {
  PlayoutClock clock(dropout_after);
  clock.add_sample(0.00, both(10.00));
  clock.add_sample(0.02, both(10.02));
  EXPECT_EQ(clock.rests_until(both(3.0)), clock.rests_until(both(10.02)));
}

/// One interval in ten times as many is a tenth of the usual one; 0.2 s of running time are silence.
TEST(PlayoutClock, SmoothsTheIntervalAndWaitsForSilence) {
  PlayoutClock clock(dropout_after);
  clock.add_sample(0.00, both(10.00));
  clock.add_sample(0.02, both(10.02));
  clock.add_sample(0.05, both(10.05));
  EXPECT_NEAR(clock.rests_until(both(10.05)), 0.05 - (0.02 + 0.1 * 0.01), 1e-12);
  for (const double running : {0.19, 0.21}) {
    PlayoutClock stood(dropout_after);
    stood.add_sample(0.00, {10.00, 0.0});
    stood.add_sample(0.02, {10.02, 0.0});
    EXPECT_EQ(std::isinf(stood.complete_until({20.0, running})), running > 0.2) << running;
  }
}

TEST(PlayoutClock, ClearForgetsAll) {
  PlayoutClock clock(dropout_after);
  clock.add_sample(0.00, both(10.00));
  clock.add_sample(0.02, both(10.02));
  clock.clear();
  EXPECT_EQ(clock.complete_until(both(11.0)), -infinity);
}

}  // namespace
}  // namespace spring_workbench::hand_input::playout_clock_test
