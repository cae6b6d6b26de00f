// The hand is moved without its tool; the hand's lengths in the world.
#include <gtest/gtest.h>

#include <cmath>

#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"
#include "support/named.h"

namespace spring_workbench::simulation::clutch_test {
namespace {

const Vector3d above(0.0, 0.0, 0.7);  // the tip of a 0.2 m fork is in the box

scene::Scene one_box(scene::ContactMode contact = scene::ContactMode::none) {
  return scene_of({box("box", {0.1, 0.06, 0.04}, 1.0, {0.02, 0.0, 0.5})}, contact);
}

const RigidTransform& pose(const Simulation& simulation) { return simulation.objects()[0].X_WO; }

TEST(Clutch, WhatIsHeldRestsWhileTheHandGoesHalfAMetre) {
  for (const tools::Tool tool :
       {tools::Tool::spring_fork, tools::Tool::spring, tools::Tool::direct, tools::Tool::ray}) {
    SimulationSettings set;
    set.tool = tool;
    Simulation simulation(one_box(), set);
    const Vector3d start = Vector3d(0.02, 0.0, tool == tools::Tool::direct ? 0.5 : 0.7);
    const Vector3d away = start + Vector3d(0.3, 0.4, 0.0);
    push_move(simulation, 0.0, 60.0, start, start);
    push_move(simulation, 60.02, 62.0, start, away);
    simulation.push_button(0.0, true);
    simulation.advance(60.0);
    ASSERT_TRUE(simulation.objects()[0].held) << validation::name_of(tool);
    simulation.push_clutch(60.0, true);
    const RigidTransform before = pose(simulation);
    for (int i = 1; i <= 100; ++i) {
      simulation.advance(60.0 + 0.02 * i);
      ASSERT_LT((pose(simulation).matrix() - before.matrix()).cwiseAbs().maxCoeff(), 1e-9) << i;
    }
    // Then it goes on from there: the object goes as far as the hand.
    simulation.push_clutch(62.0, false);
    push_move(simulation, 62.02, 64.0, away, start);
    push_move(simulation, 64.02, 70.0, start, start);
    simulation.advance(70.0);
    EXPECT_LT((simulation.fork().X_WS.translation() - (start + start - away)).norm(), 1e-9);
    if (tool == tools::Tool::spring) continue;  // a pendulum without a damper across
    const Vector3d gone = pose(simulation).translation() - before.translation();
    EXPECT_LT((gone - (start - away)).norm(), 1e-6) << validation::name_of(tool);
  }
}

/// The tool turns in world as the hand does, whatever the hand's attitude was when it was joined to the tool again.
TEST(Clutch, TheToolTurnsAsTheHandDoesInWorld) {
  Simulation simulation(one_box(), SimulationSettings());
  const auto turned = [&](double t0, const Quaterniond& from, const Vector3d& by) {
    for (int i = 0; i <= 50; ++i) {
      const double u = i / 50.0, s = u * u * (3.0 - 2.0 * u);
      const Quaterniond turn(Eigen::AngleAxisd(s * by.norm(), by.normalized()));
      simulation.push_stylus({t0 + 0.02 * i, make_transform(turn * from, Vector3d(s, -s, 0.5))});
    }
  };
  const Quaterniond down(0.0, 1.0, 0.0, 0.0), tilted = Quaterniond(Eigen::AngleAxisd(0.9, Vector3d::UnitY())) * down;
  turned(0.0, down, {0.0, 0.9, 0.0});
  simulation.push_clutch(0.0, true);
  simulation.push_clutch(1.0, false);
  turned(1.02, tilted, {0.3, -0.2, 0.5});
  simulation.advance(1.02);
  EXPECT_LT((simulation.fork().X_WS.linear() - down.toRotationMatrix()).norm(), 1e-9);
  simulation.advance(2.02);
  const Vector3d by(0.3, -0.2, 0.5);
  const Matrix3d expected = Eigen::AngleAxisd(by.norm(), by.normalized()) * down.toRotationMatrix();
  EXPECT_LT((simulation.fork().X_WS.linear() - expected).norm(), 1e-9);
}

TEST(Clutch, OnAndOffAtFullSpeedNothingJumps) {
  for (const double pressed : {0.513, 0.76, 1.0}) {
    Simulation simulation(one_box(), SimulationSettings());
    push_move(simulation, 0.0, 2.0, above, above + Vector3d(0.4, 0.0, 0.1), 1.0);
    simulation.push_button(0.0, true);
    simulation.push_clutch(pressed, true);
    simulation.push_clutch(pressed + 0.3, false);
    for (const double t : {pressed, pressed + 0.3}) {
      simulation.advance(t - 1e-7);
      const bodies::BodyState before = simulation.objects()[0];
      simulation.advance(t + 1e-7);
      const bodies::BodyState& after = simulation.objects()[0];
      EXPECT_LT((after.X_WO.matrix() - before.X_WO.matrix()).norm(), 1e-6) << t;
      EXPECT_LT((after.V_WO_W.linear - before.V_WO_W.linear).norm(), 1e-4) << t;
      EXPECT_LT((after.V_WO_W.angular - before.V_WO_W.angular).norm(), 1e-3) << t;
    }
  }
}

/// What follows the clutch is the motion that a hand would make that had been there all the time.
TEST(Clutch, AfterItTheToolGoesAsOfAHandThatIsThere) {
  const Vector3d by(0.1, -0.2, 0.05);
  const auto run = [&](bool clutched) {
    Simulation simulation(one_box(), SimulationSettings());
    simulation.push_button(0.0, true);
    push_move(simulation, 0.0, 0.5, above, above);
    push_move(simulation, 0.52, 1.0, above, clutched ? Vector3d(above + by) : above);
    push_move(simulation, 1.02, 1.5, clutched ? Vector3d(above + by) : above, clutched ? Vector3d(above + by) : above);
    if (clutched) simulation.push_clutch(0.4, true);
    if (clutched) simulation.push_clutch(1.2, false);
    const Vector3d from = clutched ? Vector3d(above + by) : above;
    push_move(simulation, 1.52, 2.5, from, from + Vector3d(0.2, 0.1, 0.2), 0.8);
    simulation.advance(2.3);
    return simulation.objects()[0];
  };
  const bodies::BodyState there = run(false), clutched = run(true);
  EXPECT_LT((there.X_WO.matrix() - clutched.X_WO.matrix()).norm(), 1e-6);
  EXPECT_LT((there.V_WO_W.linear - clutched.V_WO_W.linear).norm(), 1e-6);
}

TEST(HandScale, TheToolGoesSoManyTimesAsFar) {
  for (const double scale : {0.1, 1.0, 7.0}) {
    SimulationSettings set;
    set.hand_scale = scale;
    set.tool = tools::Tool::direct;
    Simulation simulation(one_box(), set);
    const Vector3d start = Vector3d(0.02, 0.0, 0.5) / scale, by(0.05, 0.02, 0.1);
    push_move(simulation, 0.0, 1.0, start, start + by, 0.5);
    simulation.push_button(0.0, true);
    simulation.advance(0.01);
    const RigidTransform before = pose(simulation);
    simulation.advance(1.0);
    EXPECT_LT((pose(simulation).translation() - before.translation() - scale * by).norm(), 1e-4 * scale);
    EXPECT_NEAR(Eigen::AngleAxisd(before.linear().transpose() * pose(simulation).linear()).angle(), 0.5, 1e-4);
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::clutch_test
