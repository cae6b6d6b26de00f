// The clutch, and the scales of the hand's lengths and time.
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
    simulation.advance_to(60.0);
    ASSERT_TRUE(simulation.objects()[0].held) << validation::name_of(tool);
    simulation.push_clutch(60.0, true);
    const RigidTransform before = pose(simulation);
    for (int i = 1; i <= 100; ++i) {
      simulation.advance_to(60.0 + 0.02 * i);
      ASSERT_LT((pose(simulation).matrix() - before.matrix()).cwiseAbs().maxCoeff(), 1e-9) << i;
    }
    // Then it continues from there: the object moves as far as the hand.
    simulation.push_clutch(62.0, false);
    push_move(simulation, 62.02, 64.0, away, start);
    push_move(simulation, 64.02, 70.0, start, start);
    simulation.advance_to(70.0);
    EXPECT_LT((simulation.tool().X_WS.translation() - (start + start - away)).norm(), 1e-9);
    if (tool == tools::Tool::spring) continue;  // a pendulum without a damper across
    const Vector3d gone = pose(simulation).translation() - before.translation();
    EXPECT_LT((gone - (start - away)).norm(), 1e-6) << validation::name_of(tool);
  }
}

/// The tool rotates in world like the hand, whatever the hand's orientation was when the clutch was released.
TEST(Clutch, TheToolTurnsAsTheHandDoesInWorld) {
  Simulation simulation(one_box(), SimulationSettings());
  const auto turned = [&](double t0, const Quaterniond& from, const Vector3d& by) {
    for (int i = 0; i <= 50; ++i) {
      const double u = i / 50.0, s = u * u * (3.0 - 2.0 * u);
      const Quaterniond turn(Eigen::AngleAxisd(s * by.norm(), by.normalized()));
      simulation.push_stylus({t0 + 0.02 * i, make_transform(Vector3d(s, -s, 0.5), turn * from)});
    }
  };
  const Quaterniond down(0.0, 1.0, 0.0, 0.0), tilted = Quaterniond(Eigen::AngleAxisd(0.9, Vector3d::UnitY())) * down;
  turned(0.0, down, {0.0, 0.9, 0.0});
  simulation.push_clutch(0.0, true);
  simulation.push_clutch(1.0, false);
  turned(1.02, tilted, {0.3, -0.2, 0.5});
  simulation.advance_to(1.02);
  EXPECT_LT((simulation.tool().X_WS.linear() - down.toRotationMatrix()).norm(), 1e-9);
  simulation.advance_to(2.02);
  const Vector3d by(0.3, -0.2, 0.5);
  const Matrix3d expected = Eigen::AngleAxisd(by.norm(), by.normalized()) * down.toRotationMatrix();
  EXPECT_LT((simulation.tool().X_WS.linear() - expected).norm(), 1e-9);
}

TEST(Clutch, OnAndOffAtFullSpeedNothingJumps) {
  for (const double pressed : {0.513, 0.76, 1.0}) {
    Simulation simulation(one_box(), SimulationSettings());
    push_move(simulation, 0.0, 2.0, above, above + Vector3d(0.4, 0.0, 0.1), 1.0);
    simulation.push_button(0.0, true);
    simulation.push_clutch(pressed, true);
    simulation.push_clutch(pressed + 0.3, false);
    for (const double t : {pressed, pressed + 0.3}) {
      simulation.advance_to(t - 1e-7);
      const bodies::BodyState before = simulation.objects()[0];
      simulation.advance_to(t + 1e-7);
      const bodies::BodyState& after = simulation.objects()[0];
      EXPECT_LT((after.X_WO.matrix() - before.X_WO.matrix()).norm(), 1e-6) << t;
      EXPECT_LT((after.V_WO_W.linear - before.V_WO_W.linear).norm(), 1e-4) << t;
      EXPECT_LT((after.V_WO_W.angular - before.V_WO_W.angular).norm(), 1e-3) << t;
    }
  }
}

/// With a tool that has springs neither strain nor twist jumps, so a clutch adds no energy.
TEST(Clutch, OnAndOffAtFullSpeedNoEnergyIsAdded) {
  for (const tools::Tool tool : {tools::Tool::spring_fork, tools::Tool::spring}) {
    SimulationSettings set;
    set.tool = tool;
    Simulation simulation(one_box(), set);
    push_move(simulation, 0.0, 2.0, above, above + Vector3d(0.4, 0.0, 0.1), 1.0);
    simulation.push_button(0.0, true);
    for (const double t : {0.513, 0.76}) {
      simulation.advance_to(t);
      const double before = simulation.energy();
      ASSERT_GT(simulation.elastic_energy(), 1e-3);
      simulation.push_clutch(t, t < 0.6);
      simulation.advance_to(t);
      ASSERT_EQ(simulation.tool().clutch, t < 0.6);
      EXPECT_NEAR(simulation.energy(), before, 1e-12) << t;
    }
  }
}

/// After the clutch, the motion is that of a hand that had been there all the time.
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
    simulation.advance_to(2.3);
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
    simulation.advance_to(0.01);
    const RigidTransform before = pose(simulation);
    simulation.advance_to(1.0);
    EXPECT_LT((pose(simulation).translation() - before.translation() - scale * by).norm(), 1e-4 * scale);
    EXPECT_NEAR(Eigen::AngleAxisd(before.linear().transpose() * pose(simulation).linear()).angle(), 0.5, 1e-4);
  }
}

/// A hand that grasps, lifts, uses its clutch, is subject to a machine's force and releases over a bench, with all
/// times divided by `rate`.
void live_through(double rate, Simulation& simulation) {
  for (int i = 0; i <= 200; ++i) {
    const double u = 0.01 * i, lift = 0.2 * u * u * (3.0 - 2.0 * u);
    if (i > 120 && i < 170) continue;  // silent for longer than its dropout_after
    simulation.push_stylus({rate * (0.02 * i), pointing_down(above + Vector3d(0.1 * u, 0.0, std::min(lift, 0.2)), u)});
  }
  simulation.push_button(rate * 0.1, true);
  simulation.push_clutch(rate * 1.0, true);
  simulation.push_clutch(rate * 1.4, false);
  simulation.push_external_wrench({rate * 1.5, {Vector3d(2.0, 0.0, 3.0), Vector3d(0.0, 0.0, 0.05)}});
  simulation.push_button(rate * 2.6, false);
  simulation.advance_to(rate * 4.0);
}

/// The law of the time scale: the result is bit-identical to that of a hand that is faster by this factor.
TEST(HandTimeScale, IsAHandThatIsSoMuchFaster) {
  for (const double scale : {0.1, 0.5, 1.0, 3.0}) {
    SimulationSettings slow, fast;
    slow.hand_time_scale = scale;
    fast.dropout_after = scale * slow.dropout_after;
    fast.external_wrench_timeout = scale * slow.external_wrench_timeout;
    Simulation a(one_box(scene::ContactMode::stop), slow), b(one_box(scene::ContactMode::stop), fast);
    live_through(1.0, a);
    live_through(scale, b);
    EXPECT_FALSE(a.objects()[0].held);
    EXPECT_EQ(a.state_hash(), b.state_hash()) << scale;
    EXPECT_EQ(a.time(), 4.0);
    EXPECT_EQ(a.world_time(), b.time());
  }
}

/// Times that the simulation tells can be asked for again.
TEST(HandTimeScale, EdgesAndSamplesAreOfTheHand) {
  SimulationSettings set;
  set.hand_time_scale = 0.3;
  Simulation simulation(one_box(), set);
  push_move(simulation, 5.0, 6.0, above, above);
  simulation.push_button(5.013, true);
  EXPECT_NEAR(simulation.time(), 5.0, 1e-12);
  EXPECT_NEAR(simulation.newest_sample_time(), 6.0, 1e-12);
  double simulated = simulation.advance_to(5.0).simulated_time;
  for (const double edge : {5.013, 5.02, 5.04}) {
    EXPECT_NEAR(simulation.next_event_time(), edge, 1e-12);
    simulated += simulation.advance_to(simulation.next_event_time()).simulated_time;
    EXPECT_NEAR(simulated, simulation.time() - 5.0, 1e-12);
    EXPECT_EQ(simulation.advance_to(simulation.time()).steps, 0);
  }
}

/// Froude's law: in a world that is λ times as large, with the same density and gravity, everything is slower by √λ.
/// With both scales the hand experiences the same motion and forces.
TEST(HandTimeScale, WithTheScalesOfLengthAndForceALargeWorldIsLikeASmallOne) {
  const auto run = [](double scale) {
    const Vector3d size(0.1, 0.06, 0.04), at(0.02, 0.0, 0.5);
    SimulationSettings set;
    set.hand_scale = scale;
    set.hand_time_scale = std::sqrt(scale);
    set.force_scale = std::pow(scale, 3);
    set.dynamics.step *= std::sqrt(scale);
    set.fork.length *= scale;
    set.fork.stiffness = {600.0 * scale * scale, 300.0 * scale * scale, 0.5 * std::pow(scale, 4)};
    set.fork.damping_ratio = {0.2, 0.2, 0.2};
    Simulation simulation(
        scene_of({box("box", scale * size, std::pow(scale, 3), scale * at)}, scene::ContactMode::none), set);
    push_move(simulation, 0.0, 1.5, above, above + Vector3d(0.2, 0.1, 0.2), 1.2);
    simulation.push_button(0.0, true);
    simulation.advance_to(1.3);
    EXPECT_TRUE(simulation.objects()[0].held);
    return simulation;
  };
  const Simulation small = run(1.0);
  for (const double scale : {0.2, 10.0}) {
    const Simulation large = run(scale);
    EXPECT_LT((pose(large).translation() / scale - pose(small).translation()).norm(), 1e-8) << scale;
    EXPECT_LT((pose(large).linear() - pose(small).linear()).norm(), 1e-7) << scale;
    const Twist V = to_hand_units(large.tool().V_WE_W, large.settings()), V_small = small.tool().V_WE_W;
    EXPECT_LT((V.linear - V_small.linear).norm(), 1e-6) << scale;
    EXPECT_LT((V.angular - V_small.angular).norm(), 1e-5) << scale;
    const Vector3d felt = large.tool().handle_wrench_H.force / large.tool().force_scale;
    EXPECT_LT((felt - small.tool().handle_wrench_H.force).norm(), 1e-5) << scale;
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::clutch_test
