// Limit cases of contact mode `dynamic`: for any masses and springs the held object stays bounded, nothing is
// penetrated, and no energy is created while the hand rests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation::dynamic_limit_cases_test {
namespace {

constexpr double g = 9.81;
constexpr double moving = 0.2, resting = 0.2;  // s, of the hand

struct LimitCase {
  std::vector<scene::Body> bodies;
  std::string held;
  Vector3d path = Vector3d::Zero();  // of the hand
  double stiffness = 5000.0;         // N/m
};

double energy(const scene::Scene& scene, const Simulation& s) {
  double sum = s.tool().elastic_energy;
  for (const scene::Body& body : scene.bodies) {
    if (!body.movable) continue;
    const bodies::BodyState& state = object(s, body.name);
    const auto& m = body.mass_properties;
    const Vector3d w_O = state.X_WO.linear().transpose() * state.V_WO_W.angular;
    sum += 0.5 * m.mass * state.V_WO_W.linear.squaredNorm() + 0.5 * w_O.dot(m.inertia_O * w_O) +
           m.mass * scene.gravity * state.X_WO.translation().z();
  }
  return sum;
}

/// The hand goes its way and rests; returns the simulation at the end.
Simulation run(const LimitCase& limit_case, unsigned seed) {
  const scene::Scene scene = scene_of(limit_case.bodies, scene::ContactMode::dynamic);
  SimulationSettings set;
  set.fork.stiffness = {limit_case.stiffness, limit_case.stiffness, 0.01 * limit_case.stiffness};
  set.grasp.object = limit_case.held;
  Simulation s(scene, set);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> some(-0.005, 0.005);
  const Vector3d start = object(s, limit_case.held).X_WO.translation() + Vector3d(0, 0, set.fork.length);
  const Vector3d end = start + limit_case.path + Vector3d(some(random), some(random), some(random));
  push_move(s, 0.0, moving, start, end, 10.0 * some(random));
  for (double t = moving + 0.02; t < moving + resting + 0.03; t += 0.02) s.push_stylus({t, pointing_down(end)});
  double weight = 0.0, lowest = std::numeric_limits<double>::infinity(), drift = 0.0;
  for (const scene::Body& body : limit_case.bodies) weight += g * body.mass_properties.mass;
  for (double t = 0.02; t < moving + resting; t += 0.02) {
    const AdvanceReport report = s.advance_to(t);
    EXPECT_EQ(report.steps_rejected, 0) << t;
    for (const bodies::BodyState& o : s.objects()) {
      EXPECT_TRUE(o.X_WO.matrix().allFinite()) << o.name << " " << t;
      EXPECT_LT(o.V_WO_W.linear.norm(), 3.0) << o.name << " " << t;
    }
    if (t < moving + 0.05) continue;
    const double now = energy(scene, s);
    lowest = std::min(lowest, now);
    drift = std::max(drift, now - lowest);
  }
  EXPECT_LE(drift, 2e-4 * weight) << "J gained by N of weight";
  return s;
}

scene::Body cube(const std::string& name, double edge, double mass, const Vector3d& p_WO) {
  return box(name, Vector3d::Constant(edge), mass, p_WO);
}

class Seeded : public ::testing::TestWithParam<unsigned> {};

TEST(LimitCases, AHeldObjectPutOnAStackOfNineLetsItStand) {
  LimitCase e;
  for (int i = 0; i < 9; ++i)
    e.bodies.push_back(box("b" + std::to_string(i), {0.1, 0.1, 0.05}, 1.0, {0, 0, 0.025 + 0.05 * i}));
  e.bodies.push_back(box("held", {0.1, 0.1, 0.05}, 1.0, {0, 0, 0.52}));
  e.held = "held";
  e.path = {0, 0, -0.05};
  const Simulation s = run(e, 0);
  for (int i = 0; i < 9; ++i) {
    const Vector3d moved = object(s, "b" + std::to_string(i)).X_WO.translation() -
                           e.bodies[static_cast<std::size_t>(i)].X_WO.translation();
    EXPECT_LT(std::abs(moved.z()), 1e-4) << i;
    EXPECT_LT(moved.norm(), 6e-3) << i;  // as far as the hand goes sideways
  }
}

TEST_P(Seeded, LightOnHeavyAndHeavyOnLight) {
  for (const auto& [held, other] : {std::pair(1e-3, 1.0), std::pair(1.0, 1e-3)}) {
    for (const double stiffness : {10.0, 1e3}) {
      LimitCase e;
      e.bodies = {cube("held", 0.06, held, {0, 0, 0.1}), cube("other", 0.06, other, {0.01, 0, 0.03})};
      e.held = "held";
      e.path = {0, 0, -0.03};
      e.stiffness = stiffness;
      const Simulation s = run(e, GetParam());
      const double below = object(s, "other").X_WO.translation().z(), above = object(s, "held").X_WO.translation().z();
      EXPECT_GT(below, 0.03 - 1e-4) << held << " " << stiffness;
      EXPECT_LT(below, 0.031) << held << " " << stiffness;  // it may be tilted a little: the hand goes sideways, too
      EXPECT_GT(above - below, 0.06 - 2e-4) << held << " " << stiffness;
    }
  }
}

TEST_P(Seeded, AMasslessOneStopsAtAWall) {
  LimitCase e;
  e.bodies = {cube("held", 0.06, 1.0, {0, 0, 0.1}), box("wall", {0.02, 0.4, 0.4}, 0.0, {0.06, 0, 0.2})};
  e.bodies[0].mass_properties = scene::MassProperties();
  e.held = "held";
  e.path = {0.04, 0, 0};
  const Simulation s = run(e, GetParam());
  EXPECT_NEAR(object(s, "held").X_WO.translation().x(), 0.02, 2e-3);
}

TEST_P(Seeded, GraspedWhileItTouches) {
  for (const double stiffness : {100.0, 1e7}) {
    LimitCase e;
    e.bodies = {cube("held", 0.06, 0.5, {0, 0, 0.03}), cube("neighbour", 0.06, 0.5, {0.06, 0, 0.03}),
                cube("above", 0.04, 0.2, {0, 0, 0.08}), box("wall", {0.02, 0.4, 0.4}, 0.0, {-0.04, 0, 0.2})};
    e.held = "held";
    e.path = {0.0, 0, 0.1};
    e.stiffness = stiffness;
    const Simulation s = run(e, GetParam());
    EXPECT_GT(object(s, "held").X_WO.translation().x(), -2e-4) << stiffness;
    EXPECT_LT((object(s, "neighbour").X_WO.translation() - Vector3d(0.06, 0, 0.03)).norm(), 0.05) << stiffness;
  }
}

INSTANTIATE_TEST_SUITE_P(LimitCases, Seeded, ::testing::Range(0u, 2u));

}  // namespace
}  // namespace spring_workbench::simulation::dynamic_limit_cases_test
