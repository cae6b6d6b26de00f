// Contact mode `dynamic`: the held object among movable ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation::dynamic_contact_test {
namespace {

using spring_workbench::scene_of;  // beside the one below

constexpr double g = 9.81;

scene::Scene scene_of(std::vector<scene::Body> bodies, double friction = 0.5) {
  return spring_workbench::scene_of(std::move(bodies), scene::ContactMode::dynamic, friction);
}

/// Samples at 50 Hz from `a` to `b` at constant speed.
void push_line(Simulation& simulation, double t0, double t1, const Vector3d& a, const Vector3d& b) {
  for (double t = t0; t < t1 + 1e-9; t += 0.02)
    simulation.push_stylus({t, pointing_down(a + (t - t0) / (t1 - t0) * (b - a))});
}

/// Poses of what is held, turned and pressed askew onto the bench and into a wall, at every sample.
std::vector<RigidTransform> pressed_askew(scene::Scene scene, scene::ContactMode contact, AdvanceReport& sum) {
  scene.contact = contact;
  SimulationSettings set;
  set.grasp.object = "held";
  Simulation s(scene, set);
  const Vector3d start(0, 0, 0.05 + set.fork.length);
  push_move(s, 0.0, 1.0, start, start + Vector3d(0.25, 0.05, -0.06), 1.0);
  std::vector<RigidTransform> poses;
  for (double t = 0.02; t < 1.0; t += 0.02) {
    const AdvanceReport report = s.advance_to(t);
    sum.steps_among_movable += report.steps_among_movable;
    poses.push_back(s.objects()[0].X_WO);
  }
  return poses;
}

TEST(DynamicContact, WhereNothingMovableIsNearItIsStop) {
  const scene::Body held = box("held", Vector3d(0.1, 0.06, 0.04), 1.0, Vector3d(0, 0, 0.05));
  const scene::Body wall = box("wall", Vector3d(0.02, 1.0, 1.0), 0.0, Vector3d(0.22, 0, 0.5));
  const scene::Scene far_away = scene_of({held, wall, box("far", Vector3d(0.1, 0.1, 0.1), 1.0, Vector3d(-1, 0, 0.05))});
  AdvanceReport none, stop, dynamic;
  const std::vector<RigidTransform> free = pressed_askew(far_away, scene::ContactMode::none, none);
  const std::vector<RigidTransform> swept = pressed_askew(far_away, scene::ContactMode::stop, stop);
  const std::vector<RigidTransform> looked_after = pressed_askew(far_away, scene::ContactMode::dynamic, dynamic);
  EXPECT_GT((free.back().translation() - swept.back().translation()).norm(), 0.02);  // there was contact
  EXPECT_EQ(dynamic.steps_among_movable, 0);
  for (std::size_t i = 0; i < swept.size(); ++i) EXPECT_EQ(swept[i].matrix(), looked_after[i].matrix()) << i;
}

// A neighbour that is near but not in contact changes only the engine that is used.
TEST(DynamicContact, ANeighbourThatIsNotTouchedIsNotFelt) {
  const auto dragged_past = [](double gap) {
    scene::Scene scene = scene_of({box("held", Vector3d(0.1, 0.1, 0.04), 1.0, Vector3d(0, 0, 0.02)),
                                   box("beside", Vector3d(0.1, 0.1, 0.04), 1.0, Vector3d(0.15, 0.1 + gap, 0.02))});
    SimulationSettings set;
    set.fork.shape = rod::ShapeKind::bushing;
    set.fork.stiffness = {2000.0, 2000.0, 50.0};
    set.grasp.object = "held";
    set.dynamics.step = 0.002;
    Simulation s(scene, set);
    const Vector3d start(0, 0, set.fork.length);
    push_move(s, 0.0, 2.0, start, start + Vector3d(0.4, 0, 0));
    AdvanceReport sum;
    std::vector<Vector3d> path;
    for (double t = 0.02; t < 2.0; t += 0.02) {
      sum.steps_among_movable += s.advance_to(t).steps_among_movable;
      path.push_back(s.objects()[0].X_WO.translation());
    }
    return std::pair(sum.steps_among_movable, path);
  };
  const auto [far_steps, far_path] = dragged_past(1.0);
  const auto [near_steps, near_path] = dragged_past(1e-3);
  EXPECT_EQ(far_steps, 0);
  EXPECT_GT(near_steps, 100);
  for (std::size_t i = 0; i < far_path.size(); ++i) EXPECT_LT((far_path[i] - near_path[i]).norm(), 1e-4) << i;
}

// The drag scene: 5 kg pressed 0.1 m below the plane by the hand, dragged 0.5 m; with springs that do not bend into
// each other the lag is μ k_stretch 0.1 m / k_bend, and the weight presses beside.
struct DragOn {
  scene::ContactMode contact;
  double slab;  // height of a movable slab on the bench, on which the box is dragged [m]; 0: none
};
class Drag : public ::testing::TestWithParam<DragOn> {};

TEST_P(Drag, TheBoxLagsByCoulombsLaw) {
  for (const double factor : {0.1, 1.0, 100.0, 1e6}) {
    for (const double mu : {0.0, 0.5, 1.0}) {
      const double floor = GetParam().slab;
      scene::Scene scene = scene_of({box("box", Vector3d(0.2, 0.1, 0.05), 5.0, Vector3d(0, 0, floor + 0.025), mu)}, mu);
      scene.contact = GetParam().contact;
      if (floor > 0.0) {
        // Without friction the slab stays by its inertia alone: pressed by up to 5e8 N, it slides away at any tilt.
        const double mass = mu > 0.0 ? 1e3 : 1e6;
        scene.bodies.push_back(box("slab", Vector3d(2.0, 1.0, floor), mass, Vector3d(0, 0, 0.5 * floor), mu));
        scene.bench_material.friction = 4.0;  // on which the slab stays
      }
      SimulationSettings set;
      set.fork.shape = rod::ShapeKind::bushing;
      set.fork.length = 0.2;
      set.fork.stiffness = {5000.0 * factor, 5000.0 * factor, 200.0 * factor};
      set.dynamics.step = mu == 0.5 ? 0.004 : 0.02;
      set.grasp.object = "box";
      Simulation s(scene, set);
      const double z = floor + 0.225;
      push_move(s, 0.0, 1.0, {0, 0, z}, {0, 0, z - 0.1});
      push_line(s, 1.02, 6.02, {0, 0, z - 0.1}, {0.5, 0, z - 0.1});
      double deepest = 0.0;
      for (int i = 1; i <= 300; ++i) {
        s.advance_to(0.02 * i);
        const RigidTransform& X = s.objects()[0].X_WO;
        deepest = std::max(deepest,
                           X.linear().row(2).cwiseAbs().dot(Vector3d(0.1, 0.05, 0.025)) + floor - X.translation().z());
      }
      EXPECT_LE(deepest, 1e-5) << factor << " " << mu;
      const double pressed = 5000.0 * factor * 0.1 + 5.0 * g;
      const Vector3d p = s.objects()[0].X_WO.translation();
      const double lag = s.tool().X_WH.translation().x() - p.x();
      // Friction acts below the tip: its moment would bend the slope spring, but the flush face prevents it.
      EXPECT_NEAR(lag, mu * pressed / (5000.0 * factor), 1e-3 * std::max(mu, 0.1) * 0.1) << factor << " " << mu;
      EXPECT_NEAR(p.z(), floor + 0.025, 1e-5) << factor << " " << mu;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, Drag,
                         ::testing::Values(DragOn{scene::ContactMode::stop, 0.0},
                                           DragOn{scene::ContactMode::dynamic, 0.0},
                                           DragOn{scene::ContactMode::dynamic, 0.1}),
                         [](const auto& tested) {
                           if (tested.param.slab > 0.0) return "on_a_slab_dynamic";
                           return tested.param.contact == scene::ContactMode::stop ? "stop" : "dynamic";
                         });

TEST(DynamicContact, LiftsAStackAndPutsItDown) {
  scene::Scene scene = scene_of({box("lower", Vector3d(0.1, 0.1, 0.04), 1.0, Vector3d(0, 0, 0.02)),
                                 box("upper", Vector3d(0.06, 0.06, 0.04), 0.5, Vector3d(0.02, 0, 0.06))});
  SimulationSettings set;
  set.fork.stiffness = {5000.0, 5000.0, 50.0};
  set.grasp.object = "lower";
  Simulation s(scene, set);
  const Vector3d start(0, 0, 0.02 + set.fork.length);
  push_move(s, 0.0, 1.0, start, start + Vector3d(0, 0, 0.1));
  s.advance_to(0.98);
  push_move(s, 1.02, 2.0, start + Vector3d(0, 0, 0.1), start + Vector3d(0, 0, 0.1));
  s.advance_to(1.98);
  const RigidTransform X = object(s, "lower").X_WO;
  const Vector3d on_top = X.inverse() * object(s, "upper").X_WO.translation();
  EXPECT_NEAR(X.translation().z(), 0.12 - 1.5 * g / 5000.0, 1e-3);
  EXPECT_LT((on_top - Vector3d(0.02, 0, 0.04)).norm(), 1e-3);
  EXPECT_FALSE(object(s, "upper").asleep);
  push_move(s, 2.02, 3.0, start + Vector3d(0, 0, 0.1), start);
  push_move(s, 3.02, 5.0, start, start);
  s.advance_to(5.0);
  EXPECT_NEAR(object(s, "upper").X_WO.translation().z(), 0.06, 2e-4);
}

TEST(DynamicContact, WhatIsCarriedDoesNotSlipOnWhatCarriesIt) {
  scene::Scene scene = scene_of({box("tray", Vector3d(0.2, 0.2, 0.02), 1.0, Vector3d(0, 0, 0.05)),
                                 box("load", Vector3d(0.06, 0.06, 0.04), 0.5, Vector3d(0, 0, 0.08))});
  SimulationSettings set;
  set.fork.stiffness = {5000.0, 5000.0, 50.0};
  set.grasp.object = "tray";
  Simulation s(scene, set);
  const Vector3d start(0, 0, 0.05 + set.fork.length);
  push_move(s, 0.0, 1.0, start, start + Vector3d(0.1, 0, 0));
  s.advance_to(0.5);
  EXPECT_GT(object(s, "load").V_WO_W.linear.norm(), 0.1);
  const auto& contacts = s.contacts();
  EXPECT_FALSE(contacts.empty());
  for (const contact::ContactState& c : contacts) EXPECT_LT(c.slip_speed, 2e-3) << c.object << " on " << c.other;
}

TEST(DynamicContact, PushesANeighbourAlong) {
  scene::Scene scene = scene_of({box("pusher", Vector3d(0.1, 0.1, 0.04), 1.0, Vector3d(0, 0, 0.03)),
                                 box("pushed", Vector3d(0.1, 0.1, 0.06), 1.0, Vector3d(0.2, 0, 0.03))});
  SimulationSettings set;
  set.grasp.object = "pusher";
  Simulation s(scene, set);
  const Vector3d start(0, 0, 0.04 + set.fork.length);
  push_move(s, 0.0, 2.0, start, start + Vector3d(0.3, 0, 0));
  s.advance_to(1.98);
  const double gap = object(s, "pushed").X_WO.translation().x() - object(s, "pusher").X_WO.translation().x() - 0.1;
  EXPECT_NEAR(gap, 0.0, 2e-3);
  EXPECT_NEAR(object(s, "pushed").X_WO.translation().z(), 0.03, 1e-4);
}

TEST(DynamicContact, LightAndHeavyStiffAndSoftAgainstAWallStayBounded) {
  for (const double mass : {1e-6, 1e-3, 1.0, 1e6}) {
    for (const double k : {1e-2, 1e1, 1e3, 1e6, 1e9}) {
      scene::Scene scene = scene_of({box("box", Vector3d(0.1, 0.1, 0.1), mass, Vector3d(0, 0, 0.5)),
                                     box("wall", Vector3d(0.1, 1.0, 1.0), 0.0, Vector3d(0.3, 0, 0.5))});
      scene.gravity = 0.0;
      SimulationSettings set;
      set.fork.stiffness = {k, k, k * 0.01};
      set.grasp.object = "box";
      Simulation s(scene, set);
      const Vector3d start(0, 0, 0.5 + set.fork.length);
      push_move(s, 0.0, 0.5, start, start + Vector3d(0.22, 0, 0));
      push_move(s, 0.52, 1.0, start + Vector3d(0.22, 0, 0), start + Vector3d(0.22, 0, 0));
      for (double t = 0.02; t < 1.0 + 1e-9; t += 0.02) {
        EXPECT_EQ(s.advance_to(t).steps_rejected, 0) << mass << " " << k;
        const bodies::BodyState& box_state = s.objects()[0];
        const RigidTransform& X = box_state.X_WO;
        ASSERT_TRUE(X.matrix().allFinite()) << mass << " " << k;
        const double reach = X.linear().row(0).cwiseAbs().sum() * 0.05;
        EXPECT_LT(X.translation().x() + reach, 0.25 + 2e-4) << mass << " " << k << " " << t;
        EXPECT_LT((X.translation() - Vector3d(0, 0, 0.5)).norm(), 0.25) << mass << " " << k;
        EXPECT_LT(box_state.V_WO_W.linear.norm(), 2.0) << mass << " " << k;  // the hand's fastest is 0.83 m/s
      }
    }
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::dynamic_contact_test
