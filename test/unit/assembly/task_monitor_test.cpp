#include "spring_workbench/assembly/task_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spring_workbench/math/so3.h"
#include "support/random_poses.h"

namespace spring_workbench::assembly::task_monitor_test {
namespace {

constexpr double edge = 0.1;  // [m] of the box

constexpr double unbreakable = std::numeric_limits<double>::infinity();

/// A box of 1 kg on the bench at the origin, wanted at x = 0.2, and a wall at x = 0.4.
scene::Scene box_scene(double max_force = unbreakable) {
  scene::Scene scene;
  scene::Body box;
  box.name = "box";
  box.movable = true;
  box.X_WO.translation() = Vector3d(0.0, 0.0, 0.5 * edge);
  box.mass_properties = {1.0, edge * edge / 6.0 * Matrix3d::Identity()};
  box.collision = {{geometry::Box{Vector3d::Constant(edge)}}};
  scene::Body wall;
  wall.name = "wall";
  wall.X_WO.translation() = Vector3d(0.4, 0.0, 0.5);
  wall.collision = {{geometry::Box{Vector3d(0.02, 1.0, 1.0)}}};
  scene.bodies = {box, wall};
  scene.targets["box"].X_WL.translation() = Vector3d(0.2, 0.0, 0.5 * edge);
  scene.targets["box"].max_force = max_force;
  return scene;
}

/// A hand above the box that moves from point to point at constant speed; the monitor observes every sample.
class Assembly {
 public:
  explicit Assembly(double max_force = unbreakable, tools::Release release = tools::Release::dropped)
      : scene_(box_scene(max_force)), simulation_(scene_, settings(release)), monitor_(scene_) {
    go(0.02, Vector3d::Zero());
  }
  static simulation::SimulationSettings settings(tools::Release release) {
    simulation::SimulationSettings s;
    s.grasp.release = release;
    return s;
  }
  /// Moves the hand by `way` in `seconds`.
  void go(double seconds, const Vector3d& way) {
    const int samples = static_cast<int>(std::lround(seconds / 0.02));
    for (int k = 0; k < samples; ++k) {
      p_ += way / samples;
      motion::PoseSample sample;
      sample.t = t_;
      sample.X = make_transform(p_, Quaterniond(0.0, 1.0, 0.0, 0.0));
      simulation_.push_stylus(sample);
      simulation_.advance_to(t_);
      monitor_.observe(simulation_);
      t_ += 0.02;
    }
  }
  void press(bool pressed) { simulation_.push_button(t_, pressed); }
  const TaskScore& score() const { return monitor_.score(); }
  TaskMonitor& monitor() { return monitor_; }

 private:
  const scene::Scene scene_;
  simulation::Simulation simulation_;
  TaskMonitor monitor_;
  double t_ = 0.0;
  Vector3d p_{0.0, 0.0, 0.25};
};

TEST(Placement, IsTheDistanceFromTheTargetWhereverTheCentreOfMassIs) {
  test_support::Random random(3);
  for (int i = 0; i < 200; ++i) {
    scene::Body body;
    body.name = "thing";
    body.X_OL.translation() = random.vector(0.3);
    scene::Target target;
    target.X_WL = random.pose(1.0);
    target.position_tolerance = 0.02;
    target.angle_tolerance = 0.3;
    const double distance = random.number(0.0, 0.04), angle = random.number(0.0, 0.6);
    RigidTransform X_TL = RigidTransform::Identity();
    X_TL.translation() = distance * random.direction();
    X_TL.linear() = math::exp_so3(angle * random.direction());
    const RigidTransform X_WO = target.X_WL * X_TL * body.X_OL.inverse();
    const Placement p = judge_placement(body, target, X_WO, false);
    EXPECT_NEAR(p.position_error, distance, 1e-12);
    EXPECT_NEAR(p.angle_error, angle, 1e-7);
    EXPECT_EQ(p.in_place, distance < 0.02 && angle < 0.3);
    EXPECT_FALSE(judge_placement(body, target, X_WO, true).in_place);
  }
}

TEST(TaskMonitor, CarryingTheBoxToItsTargetIsComplete) {
  Assembly assembly;
  EXPECT_EQ(assembly.score().targets, 1);
  EXPECT_NEAR(assembly.monitor().placements()[0].position_error, 0.2, 1e-12);
  assembly.press(true);
  assembly.go(1.0, Vector3d(0.0, 0.0, 0.1));
  assembly.go(1.0, Vector3d(0.2, 0.0, 0.0));
  assembly.go(1.0, Vector3d::Zero());
  EXPECT_FALSE(assembly.score().complete());
  assembly.go(1.0, Vector3d(0.0, 0.0, -0.098));
  assembly.press(false);
  assembly.go(1.0, Vector3d::Zero());
  const TaskScore done = assembly.score();
  EXPECT_TRUE(done.complete());
  EXPECT_EQ(done.grasps, 1);
  EXPECT_EQ(done.drops, 0);
  EXPECT_EQ(done.collisions, 0);
  EXPECT_NEAR(done.hand_path, 0.398, 1e-9);
  EXPECT_GT(done.object_path, 0.38);
  EXPECT_LT(done.object_path, 0.45);
  EXPECT_NEAR(done.time, 4.0, 0.1);
  EXPECT_LT(done.position_error, 0.01);
  // What comes after is not counted.
  assembly.go(1.0, Vector3d(0.0, 0.0, 0.3));
  EXPECT_EQ(assembly.score().hand_path, done.hand_path);
  EXPECT_EQ(assembly.score().time, done.time);
}

TEST(TaskMonitor, LettingGoInTheAirIsADrop) {
  for (const double height : {0.01, 0.1}) {
    Assembly assembly;
    assembly.press(true);
    assembly.go(1.0, Vector3d(0.0, 0.0, height));
    assembly.go(1.0, Vector3d::Zero());
    assembly.press(false);
    assembly.go(1.0, Vector3d::Zero());
    EXPECT_EQ(assembly.score().drops, height > 0.02 ? 1 : 0) << height;
  }
}

TEST(TaskMonitor, RunningAgainstTheWallIsOneCollision) {
  Assembly assembly;
  assembly.press(true);
  assembly.go(1.0, Vector3d(0.0, 0.0, 0.1));
  EXPECT_EQ(assembly.score().collisions, 0);
  assembly.go(1.0, Vector3d(0.38, 0.0, 0.0));
  assembly.go(1.0, Vector3d::Zero());
  EXPECT_EQ(assembly.score().collisions, 1);
  EXPECT_GT(assembly.score().largest_force, 1.0);
  EXPECT_TRUE(std::isfinite(assembly.score().largest_force));
}

/// The box is let go and falls to the bench. The force of the hit is that of its impulse over 20 ms, and for as long
/// the weight, wherever samples fall, some of them microseconds after another, and however long the steps are.
TEST(TaskMonitor, AHitHasTheSameForceHoweverSamplesFall) {
  test_support::Random random(7);
  const scene::Scene scene = box_scene();
  for (int i = 0; i < 40; ++i) {
    const double step = random.number(5e-4, 2e-2), shift = random.number(1e-4, 1.9e-2),
                 spacing = random.number(1e-6, 1e-4);
    simulation::SimulationSettings settings = Assembly::settings(tools::Release::dropped);
    settings.dynamics.step = step;
    simulation::Simulation simulation(scene, settings);
    TaskMonitor monitor(scene);
    simulation.push_button(0.0, true);
    simulation.push_button(1.0 + shift, false);
    double height = 0.0;
    for (double t = 0.0; t < 1.5; t += 0.02) {
      for (const double sample : {t, t + shift, t + shift + spacing}) {
        const Vector3d p(0.0, 0.0, 0.25 + 0.2 * std::min(sample, 0.5));
        simulation.push_stylus({sample, make_transform(p, Quaterniond(0.0, 1.0, 0.0, 0.0))});
        simulation.advance_to(sample);
        monitor.observe(simulation);
        if (simulation.objects()[0].held) height = simulation.objects()[0].X_WO.translation().z() - 0.5 * edge;
      }
    }
    const double impulse = std::sqrt(2.0 * scene.gravity * height);
    EXPECT_EQ(monitor.score().drops, 1);
    EXPECT_GT(monitor.score().largest_force, 0.99 * impulse / 0.02) << step << ' ' << shift << ' ' << spacing;
    EXPECT_LT(monitor.score().largest_force, 1.01 * impulse / 0.02 + scene.gravity)
        << step << ' ' << shift << ' ' << spacing;
  }
}

/// Against the wall and to the target: broken for good if it withstands a little less than the impact.
TEST(TaskMonitor, WhatIsPressedTooHardIsBrokenForGood) {
  double impact = 0.0;
  for (const double share : {0.0, 0.999, 1.001}) {
    Assembly assembly(share > 0.0 ? share * impact : unbreakable);
    assembly.press(true);
    assembly.go(1.0, Vector3d(0.0, 0.0, 0.1));
    assembly.go(1.0, Vector3d(0.38, 0.0, 0.0));
    assembly.go(1.0, Vector3d(-0.18, 0.0, 0.0));
    assembly.go(1.0, Vector3d::Zero());
    assembly.go(1.0, Vector3d(0.0, 0.0, -0.098));
    assembly.press(false);
    assembly.go(1.0, Vector3d::Zero());
    const bool broken = share > 0.0 && share < 1.0;
    EXPECT_EQ(assembly.score().broken, broken ? 1 : 0) << share;
    EXPECT_EQ(assembly.monitor().placements()[0].broken, broken) << share;
    EXPECT_EQ(assembly.score().complete(), !broken) << share;
    EXPECT_LT(assembly.score().position_error, 0.01) << share;
    if (share == 0.0) impact = assembly.score().largest_force;
    EXPECT_EQ(assembly.score().largest_force, impact) << share;
    assembly.monitor().reset();
    EXPECT_EQ(assembly.score().broken, 0);
  }
}

TEST(TaskMonitor, ResetForgetsAll) {
  Assembly assembly;
  assembly.press(true);
  assembly.go(1.0, Vector3d(0.0, 0.0, 0.1));
  assembly.monitor().reset();
  EXPECT_EQ(score_csv(assembly.score()), score_csv(TaskMonitor(box_scene()).score()));
}

/// Three hands lift a box each and release it in the air: all are counted. Then all lift the same box: each grasp is
/// counted, and the path of the box once.
TEST(TaskMonitor, EveryHandScores) {
  scene::Scene scene = box_scene();
  for (const double y : {0.3, -0.3}) {
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies.back().name = y > 0.0 ? "second" : "third";
    scene.bodies.back().X_WO.translation().y() = y;
  }
  simulation::SimulationSettings settings = Assembly::settings(tools::Release::dropped);
  settings.styluses = 3;
  for (const bool same : {false, true}) {
    simulation::Simulation simulation(scene, settings);
    TaskMonitor monitor(scene);
    for (int k = 0; k <= 150; ++k) {
      const double t = 0.02 * k, z = 0.25 + 0.1 * std::min(t, 1.0);
      for (std::size_t hand = 0; hand < 3; ++hand) {
        const double y = (same ? 0.02 : 0.3) * (hand == 2 ? -1.0 : static_cast<double>(hand));
        simulation.push_stylus({t, make_transform(Vector3d(0.0, y, z), Quaterniond(0.0, 1.0, 0.0, 0.0))}, hand);
        if (k == 1 || k == 100) simulation.push_button(t, k == 1, hand);
      }
      simulation.advance_to(t);
      monitor.observe(simulation);
    }
    EXPECT_EQ(monitor.score().grasps, 3) << same;
    EXPECT_NEAR(monitor.score().hand_path, 0.3, 1e-9) << same;
    EXPECT_NEAR(monitor.score().object_path, same ? 0.1 : 0.3, 0.03) << same;
    EXPECT_EQ(monitor.score().drops, same ? 1 : 3);
  }
}

TEST(TaskScore, OneColumnPerValue) {
  const auto commas = [](const std::string& s) { return std::count(s.begin(), s.end(), ','); };
  EXPECT_EQ(commas(score_csv(TaskScore())), commas(score_csv_header()));
}

}  // namespace
}  // namespace spring_workbench::assembly::task_monitor_test
