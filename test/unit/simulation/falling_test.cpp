// Objects in the air at the start fall; standing ones stay.
#include <gtest/gtest.h>

#include "spring_workbench/validation/names.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation::falling_test {
namespace {

using scene::ContactMode;

constexpr double g = 9.81;

class Falling : public testing::TestWithParam<ContactMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, Falling, testing::Values(ContactMode::stop, ContactMode::dynamic),
                         [](const auto& tested) { return validation::name_of(tested.param); });

scene::Body cube(const std::string& name, const Vector3d& p_WO) {
  return box(name, Vector3d::Constant(0.1), 1.0, p_WO, 0.5);
}

/// At time 0, with no hand.
Simulation start_of(const scene::Scene& scene, const SimulationSettings& settings = {}) {
  Simulation s(scene, settings);
  s.advance_to(0.0);
  return s;
}

TEST_P(Falling, FollowsTheParabolaThenLandsAndRests) {
  scene::Body high = cube("high", Vector3d(0.0, 0.0, 0.55));
  high.X_WO.linear() = Eigen::AngleAxisd(0.4, Vector3d::UnitZ()).toRotationMatrix();
  Simulation s = start_of(scene_of({high}, GetParam()));
  for (const double t : {0.07, 0.15, 0.31}) {
    s.advance_to(t);
    const bodies::BodyState& o = object(s, "high");
    EXPECT_NEAR(o.X_WO.translation().z(), 0.55 - 0.5 * g * t * t, 1e-14);
    EXPECT_NEAR(o.V_WO_W.linear.z(), -g * t, 1e-14);
    EXPECT_LT((o.X_WO.linear() - high.X_WO.linear()).norm(), 1e-15);
    EXPECT_FALSE(o.asleep);
  }
  s.advance_to(2.0);
  EXPECT_TRUE(object(s, "high").asleep);
  EXPECT_NEAR(object(s, "high").X_WO.translation().z(), 0.05, 1e-4);
  s.reset();
  s.advance_to(2.0);
  s.advance_to(2.1);
  EXPECT_NEAR(object(s, "high").X_WO.translation().z(), 0.55 - 0.5 * g * 0.01, 1e-14);
}

TEST_P(Falling, WhatNothingCarriesFallsAndWhatStandsStays) {
  scene::Body slope = box("slope", Vector3d(0.4, 0.4, 0.1), 0.0, Vector3d(1.0, 0.0, 0.3));
  const Matrix3d tilt = Eigen::AngleAxisd(0.2, Vector3d::UnitY()).toRotationMatrix();
  slope.X_WO.linear() = tilt;
  scene::Body on_slope = cube("on the slope", slope.X_WO * Vector3d(0.0, 0.0, 0.1));
  on_slope.X_WO.linear() = tilt;
  const std::vector<std::string> stand = {"on the bench", "on it", "on the slope"};
  const scene::Scene scene = scene_of(
      {slope, on_slope, cube("on the bench", Vector3d(0.0, 0.0, 0.05)), cube("on it", Vector3d(0.02, 0.0, 0.15)),
       cube("just above", Vector3d(0.0, 1.0, 0.052)), cube("riding on that", Vector3d(0.0, 1.0, 0.152))},
      GetParam());
  Simulation s = start_of(scene);
  const std::vector<bodies::BodyState> before = s.objects();
  EXPECT_FALSE(object(s, "just above").asleep);
  EXPECT_FALSE(object(s, "riding on that").asleep);
  s.advance_to(1.0);
  for (const std::string& name : stand) {
    EXPECT_TRUE(object(s, name).asleep) << name;
    const scene::Body& body = scene.bodies[*scene::find_body(scene, name)];
    EXPECT_EQ(object(s, name).X_WO.matrix(), body.X_WO.matrix()) << name;
  }
  EXPECT_NEAR(object(s, "just above").X_WO.translation().z(), 0.05, 1e-4);
  EXPECT_NEAR(object(s, "riding on that").X_WO.translation().z(), 0.15, 2e-4);
}

TEST_P(Falling, NotWithoutGravityOrMass) {
  const scene::Scene scene = scene_of({cube("high", Vector3d(0.0, 0.0, 0.5))}, GetParam());
  SimulationSettings weightless, massless;
  weightless.gravity = 0.0;
  massless.massless = true;
  for (const SimulationSettings& settings : {weightless, massless}) {
    Simulation s = start_of(scene, settings);
    s.advance_to(1.0);
    EXPECT_EQ(object(s, "high").X_WO.translation(), Vector3d(0.0, 0.0, 0.5));
    EXPECT_TRUE(object(s, "high").asleep);
  }
}

TEST(FallingWithoutContact, NothingFalls) {
  Simulation s = start_of(scene_of({cube("high", Vector3d(0.0, 0.0, 0.5))}, ContactMode::none));
  s.advance_to(1.0);
  EXPECT_EQ(object(s, "high").X_WO.translation(), Vector3d(0.0, 0.0, 0.5));
}

TEST(Massless, EveryObjectOfTheWorldFollowsTheTipAndStaysWhereItIsReleased) {
  const Vector3d size(0.1, 0.1, 0.1);
  SimulationSettings settings;
  settings.massless = true;
  const scene::Scene scene =
      scene_of({cube("a", Vector3d(0.0, 0.0, 0.05)), cube("b", Vector3d(0.5, 0.0, 0.05))}, ContactMode::stop);
  for (const std::string name : {"a", "b"}) {
    Simulation s(scene, settings);
    const Vector3d start = object(s, name).X_WO.translation() + settings.fork.length * Vector3d::UnitZ();
    const Vector3d end = start + Vector3d(0.3, 0.2, 0.25);
    push_move(s, 0.0, 1.0, start, end, 0.7);
    s.push_button(0.0, true);
    s.push_button(0.98, false);
    s.advance_to(0.9);
    const RigidTransform X_WO = s.tool().X_WH * Eigen::Translation3d(0.0, 0.0, settings.fork.length) *
                                pointing_down(Vector3d::Zero()).inverse();
    EXPECT_TRUE(object(s, name).held);
    EXPECT_LT((object(s, name).X_WO.matrix() - X_WO.matrix()).norm(), 1e-12);
    EXPECT_EQ(s.tool().weight, 0.0);
    s.advance_to(0.99);
    const RigidTransform released = object(s, name).X_WO;
    s.advance_to(2.0);
    EXPECT_EQ(object(s, name).X_WO.matrix(), released.matrix());
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::falling_test
