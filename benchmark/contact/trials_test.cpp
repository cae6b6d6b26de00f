// Small parts of what `contact_trials` runs. The complete tables are in README.md in this folder.
#include <gtest/gtest.h>

#include <set>

#include "benchmark/contact/card_house.h"
#include "benchmark/contact/exact_motions.h"
#include "benchmark/contact/marbles.h"
#include "benchmark/contact/pegs.h"
#include "benchmark/contact/piles.h"
#include "benchmark/contact/rings.h"
#include "benchmark/contact/same_bits.h"
#include "benchmark/contact/wedge.h"

namespace spring_workbench::benchmark::trials_test {
namespace {

/// Largest distance of a body from its start [m].
double moved(const TrialRun& run) {
  double most = 0.0;
  for (std::size_t i = 0; i < run.start().size(); ++i) {
    const bodies::BodyState& now = run.simulation().objects()[i];
    if (!now.held) most = std::max(most, (now.X_WO.translation() - run.start()[i].X_WO.translation()).norm());
  }
  return most;
}

void expect_sound(const TrialRun& run) {
  const Measured m = run.measured();
  EXPECT_TRUE(m.finite && m.to_the_end);
  EXPECT_LE(m.deepest.depth, 1e-4) << m.deepest.first << " in " << m.deepest.second;
  EXPECT_EQ(m.steps_blocked, 0);
  EXPECT_EQ(m.steps_unsolved, 0);
  EXPECT_EQ(m.time_lost, 0.0);
  EXPECT_EQ(m.steps_rejected, 0);
  EXPECT_LE(m.gained_height, 3e-6);
}

TEST(ContactTrials, APileIsPushed) {
  TrialRun run(pushed_pile(2, 2, 0.02));
  while (run.advance()) continue;
  expect_sound(run);
  for (std::size_t i = 0; i < run.start().size(); ++i) {
    const Vector3d way = run.simulation().objects()[i].X_WO.translation() - run.start()[i].X_WO.translation();
    EXPECT_NEAR(way.x(), 0.05, 2e-3) << run.start()[i].name;  // the gaps, and what the fork gives way
  }
}

TEST(ContactTrials, AStackStandsAwake) {
  TrialRun run(standing_stack(1.0, 0.6));
  while (run.advance()) {
    for (const bodies::BodyState& o : run.simulation().objects()) EXPECT_TRUE(run.time() < 0.1 || !o.asleep);
  }
  expect_sound(run);
  EXPECT_LE(moved(run), 1e-5);
}

TEST(ContactTrials, ACardHouseStands) {
  TrialRun run(card_house(false, 0.4));
  while (run.advance()) continue;
  expect_sound(run);
  EXPECT_LE(moved(run), 2e-4);
}

// Cards fall on each other's edges, by less than a millimetre per substep.
TEST(ContactTrials, AFallingCardHouseFallsThroughNoCard) {
  TrialRun run(card_house(true, 0.75));
  while (run.advance()) continue;
  expect_sound(run);
}

TEST(ContactTrials, MarblesStayInTheirTray) {
  TrialRun run(tilted_marbles(18, 0.2));
  while (run.advance()) continue;
  expect_sound(run);
  EXPECT_LE(moved(run), 0.02);
}

TEST(ContactTrials, APegOfABoxGoesInWithATenthOfAMillimetre) {
  for (const scene::ContactMode contact : {scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    TrialRun run(peg_in_hole(false, contact));
    while (run.advance()) continue;
    expect_sound(run);
    EXPECT_LE(run.measured().deepest.depth, 1e-5);
    EXPECT_LE(run.pose("held").translation().z() - run.start()[0].X_WO.translation().z(), -0.03);
  }
}

// Hollow meshes that touch in several places at once.
TEST(ContactTrials, AChainHangsTogether) {
  TrialRun run(swung_chain(0));
  while (run.time() < 0.2 && run.advance()) continue;
  const Measured m = run.measured();
  EXPECT_LE(m.deepest.depth, 1e-4) << m.deepest.first << " in " << m.deepest.second;
  EXPECT_EQ(m.steps_blocked, 0);
  EXPECT_EQ(m.steps_unsolved, 0);
}

TEST(ContactTrials, AWedgeIsSqueezedOut) {
  TrialRun run(squeezed_wedge(0.05));
  while (run.advance()) continue;
  expect_sound(run);
  EXPECT_LE(run.measured().deepest.depth, 1e-5);
}

void expect_to_hold(const TrialRow& row) {
  EXPECT_TRUE(row.holds()) << row.trial << ' ' << row.name << ' ' << row.contact << ": "
                           << (row.bars.empty() ? 0.0 : row.bars[0].measured);
}

/// On a loose slab, so among movable bodies.
TEST(ContactTrials, OnALooseSlabBodiesSlideRollAndBounceExactly) {
  for (const std::string& motion : motions_in_contact()) {
    for (const auto& [step, share] : {std::pair(0.02, 1e-3), {0.005, 1e-4}, {0.00125, 1e-5}}) {
      const MotionRun run = run_motion(motion, scene::ContactMode::dynamic, step);
      EXPECT_LE(run.error, share * run.displacement) << motion << ' ' << step;
      EXPECT_LE(run.measured.deepest.depth, 1e-5) << motion << ' ' << step;
    }
  }
}

TEST(ContactTrials, InclinesHoldBelowTheAngleOfFriction) { run_inclines(true, expect_to_hold); }

TEST(ContactTrials, TheSameCallsGiveTheSameBits) { run_same_bits(true, expect_to_hold); }

}  // namespace
}  // namespace spring_workbench::benchmark::trials_test
