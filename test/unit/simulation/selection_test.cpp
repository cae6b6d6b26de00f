// Which object the fork's tip grasps, and at which point (paper, section 5).
#include <gtest/gtest.h>

#include "support/bench_scenes.h"

namespace spring_workbench::simulation::selection_test {
namespace {

constexpr double side = 0.1, apart = 0.04, reach = 0.2;
const Vector3d left(0.0, 0.0, 0.3), right(apart, 0.0, 0.3);

/// Two boxes that run into each other, their centres `apart`, and a hand above them that can go from one to the other.
class Overlapping : public ::testing::Test {
 protected:
  Overlapping()
      : simulation_(weightless(scene_of({box("left", Vector3d::Constant(side), 1.0, left),
                                         box("right", Vector3d::Constant(side), 1.0, right)},
                                        scene::ContactMode::none)),
                    SimulationSettings()) {}

  static scene::Scene weightless(scene::Scene scene) {
    scene.gravity = 0.0;
    return scene;
  }

  /// The name of what lights up, or nothing, with the tip in the height of the centres at `x`.
  std::string lit_at(double x) {
    t_ += 0.1;
    simulation_.push_stylus({t_, pointing_down({x, 0.0, left.z() + reach})});
    simulation_.advance_to(t_);
    std::string lit;
    for (const bodies::BodyState& o : simulation_.objects()) {
      if (o.highlighted) lit += o.name;
    }
    return lit;
  }

  Simulation simulation_;
  double t_ = 0.0;
};

TEST_F(Overlapping, TheOtherIsSelectedOnlyIfItIsNearerByAFifth) {
  const double there = apart / 1.8, back = apart - there;  // where one distance is 0.8 of the other
  EXPECT_EQ(lit_at(-0.051), "");
  EXPECT_EQ(lit_at(0.0), "left");
  EXPECT_EQ(lit_at(there - 1e-4), "left");
  EXPECT_EQ(lit_at(there + 1e-4), "right");
  EXPECT_EQ(lit_at(0.5 * apart), "right");
  EXPECT_EQ(lit_at(back + 1e-4), "right");
  EXPECT_EQ(lit_at(back - 1e-4), "left");
  EXPECT_EQ(lit_at(apart + 0.051), "");
}

TEST_F(Overlapping, ATipThatTremblesBetweenThemStaysWithOne) {
  const std::string first = lit_at(0.5 * apart);
  ASSERT_NE(first, "");
  for (int i = 0; i < 50; ++i) EXPECT_EQ(lit_at(0.5 * apart + (i % 2 == 0 ? 1e-3 : -1e-3)), first);
}

TEST_F(Overlapping, PressedInTheAirTheButtonGraspsNothingLater) {
  ASSERT_EQ(lit_at(-0.2), "");
  simulation_.push_button(t_, true);
  lit_at(0.0);
  EXPECT_EQ(simulation_.tool().held_object, "");
  simulation_.push_button(t_, false);
  simulation_.push_button(t_ + 0.05, true);
  lit_at(0.0);
  EXPECT_NE(simulation_.tool().held_object, "");
}

TEST_F(Overlapping, WhatIsLitIsHeldWhereTheTipIsWhileTheButtonIsDown) {
  for (const double x : {-0.04, 0.013, 0.031, 0.08}) {
    const std::string lit = lit_at(x);
    simulation_.push_button(t_, true);
    simulation_.advance_to(t_ += 0.02);
    EXPECT_EQ(simulation_.tool().held_object, lit);
    const Vector3d tip = simulation_.tool().X_WE.translation();
    EXPECT_LT((tip - Vector3d(x, 0.0, left.z())).norm(), 1e-9) << x;
    simulation_.push_button(t_, false);
    simulation_.advance_to(t_ += 0.02);
    EXPECT_EQ(simulation_.tool().held_object, "");
    simulation_.reset();
    t_ = 0.0;
  }
}

/// The probe cannot hold, so taking it in hand is a release like any other.
TEST(Release, ByTheProbeIsAsItIsSet) {
  for (const tools::Release release : {tools::Release::thrown, tools::Release::dropped}) {
    SimulationSettings set;
    set.grasp.release = release;
    Simulation simulation(scene_of({box("box", Vector3d::Constant(side), 1.0, left)}, scene::ContactMode::none), set);
    const Vector3d above = left + Vector3d(0.0, 0.0, reach);
    push_move(simulation, 0.0, 1.0, above, above + Vector3d(0.3, 0.0, 0.2));
    simulation.push_button(0.0, true);
    simulation.advance_to(0.5);
    ASSERT_TRUE(simulation.objects()[0].held);
    const Twist before = simulation.objects()[0].V_WO_W;
    ASSERT_GT(before.linear.norm(), 0.1);
    simulation.select_tool(tools::Tool::spring_probe);
    EXPECT_FALSE(simulation.objects()[0].held);
    const Vector3d after = simulation.objects()[0].V_WO_W.linear;
    EXPECT_EQ(after, release == tools::Release::thrown ? before.linear : Vector3d(Vector3d::Zero()));
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::selection_test
