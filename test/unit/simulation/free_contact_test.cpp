// Released objects on the bench and on an incline, in both contact modes, against exact solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spring_workbench/bodies/free_body.h"
#include "spring_workbench/math/so3.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation::free_contact_test {
namespace {

constexpr double g = 9.81;

std::string mode_name(const testing::TestParamInfo<scene::ContactMode>& tested) {
  return tested.param == scene::ContactMode::stop ? "stop" : "dynamic";
}

scene::Body ball(double radius, const Vector3d& p_WO, double friction, double restitution = 0.0) {
  scene::Body b = box("held", Vector3d::Ones(), 1.0, p_WO, friction);
  b.mass_properties.inertia_O = 0.4 * radius * radius * Matrix3d::Identity();
  b.material.restitution = restitution;
  b.collision[0].geometry = geometry::Sphere{radius};
  return b;
}

/// Held by a rigid fork by the middle of "held", moved along x at `speed` for 0.2 s, and let go there.
Simulation let_go(const scene::Scene& scene, double speed, double until, double step = 0.02) {
  SimulationSettings set;
  set.fork.dofs = {false, false, false};
  set.dynamics.step = step;
  Simulation s(scene, set);
  const RigidTransform& X_WO = s.objects()[s.objects().size() - 1].X_WO;
  const Vector3d start = X_WO.translation() + set.fork.length * Vector3d::UnitZ();
  for (double t = 0.0; t < until + 1e-9; t += 0.02) {
    s.push_stylus({t, pointing_down(start + std::min(t, 0.2) * speed * Vector3d::UnitX())});
  }
  s.push_button(0.0, true);
  s.push_button(0.18, false);
  s.advance_to(0.18);
  return s;
}

class LetGo : public testing::TestWithParam<scene::ContactMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, LetGo, testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         mode_name);

TEST_P(LetGo, ABoxSlidesAsFarAsFrictionLetsIt) {
  for (const double mu : {0.2, 0.4}) {
    Simulation s =
        let_go(scene_of({box("held", Vector3d(0.1, 0.1, 0.04), 1.0, Vector3d(0, 0, 0.02 + 1e-6), mu)}, GetParam(), mu),
               1.0, 3.0);
    const bodies::BodyState start = s.objects()[0];
    ASSERT_GT(start.V_WO_W.linear.x(), 0.5);
    s.advance_to(3.0);
    const double path = start.V_WO_W.linear.squaredNorm() / (2.0 * mu * g);
    EXPECT_NEAR((s.objects()[0].X_WO.translation() - start.X_WO.translation()).x(), path, 0.01 * path) << mu;
    EXPECT_TRUE(s.objects()[0].asleep) << mu;
  }
}

TEST_P(LetGo, ASphereSlipsAndThenRolls) {
  const double radius = 0.05, mu = 0.3;
  Simulation s = let_go(scene_of({ball(radius, Vector3d(0, 0, radius + 1e-6), mu)}, GetParam(), mu), 1.5, 1.2);
  const bodies::BodyState start = s.objects()[0];
  const double v = start.V_WO_W.linear.x(), grip = 2.0 * v / (7.0 * mu * g);
  ASSERT_NEAR(v, 1.5, 1e-3);
  s.advance_to(1.2);
  const double t = s.time() - 0.18, rolling = 5.0 / 7.0 * v;
  const bodies::BodyState& end = s.objects()[0];
  const double path = v * grip - 0.5 * mu * g * grip * grip + rolling * (t - grip);
  EXPECT_NEAR(end.V_WO_W.linear.x(), rolling, 0.01 * rolling);
  EXPECT_NEAR(end.V_WO_W.angular.y() * radius, end.V_WO_W.linear.x(), 0.005 * rolling);
  EXPECT_NEAR(end.X_WO.translation().x() - start.X_WO.translation().x(), path, 0.01 * path);
  EXPECT_NEAR(end.X_WO.translation().z(), radius, 2e-5);
}

TEST_P(LetGo, ASphereSlipsAndRollsAsFarInShortStepsAsInLongOnes) {
  const double radius = 0.05, mu = 0.3;
  for (const double step : {0.02, 5e-3, 1.25e-3, 6.25e-4}) {
    Simulation s = let_go(scene_of({ball(radius, Vector3d(0, 0, radius + 1e-6), mu)}, GetParam(), mu), 1.5, 0.56, step);
    const bodies::BodyState start = s.objects()[0];
    const double v = start.V_WO_W.linear.x(), grip = 2.0 * v / (7.0 * mu * g), rolling = 5.0 / 7.0 * v;
    s.advance_to(0.54);
    const double path = v * grip - 0.5 * mu * g * grip * grip + rolling * (s.time() - 0.18 - grip);
    EXPECT_NEAR((s.objects()[0].X_WO.translation() - start.X_WO.translation()).x(), path, 2e-5) << step;
    EXPECT_NEAR(s.objects()[0].V_WO_W.linear.x(), rolling, 5e-5) << step;
  }
}

/// Its distance from where it should be, every 20 ms, falls at least as the step to the power 1.8: nothing is lost or
/// gained by the step.
TEST_P(LetGo, ASphereThatSlipsAndRollsConverges) {
  const double radius = 0.05, mu = 0.4, longest = 2e-3;
  std::vector<double> errors;
  for (const double step : {longest, 5e-4, 1e-4}) {
    Simulation s = let_go(scene_of({ball(radius, Vector3d(0, 0, radius), mu)}, GetParam(), mu), 1.5, 0.74, step);
    const bodies::BodyState start = s.objects()[0];
    const double v = start.V_WO_W.linear.x(), grip = 2.0 * v / (7.0 * mu * g);
    double worst = 0.0;
    for (int i = 1; i <= 27; ++i) {
      s.advance_to(0.18 + 0.02 * i);
      const double slips = std::min(0.02 * i, grip), rolls = 0.02 * i - slips;
      const double path = v * slips - 0.5 * mu * g * slips * slips + 5.0 / 7.0 * v * rolls;
      const Vector3d exact = start.X_WO.translation() + path * Vector3d::UnitX();
      worst = std::max(worst, (s.objects()[0].X_WO.translation() - exact).norm());
    }
    errors.push_back(worst);
    EXPECT_LE(worst, std::max(5e-6 * std::pow(step / longest, 1.8), 1e-12)) << step;
  }
  EXPECT_GE(std::log(errors.front() / errors.back()) / std::log(20.0), 1.8) << errors.front() << ' ' << errors.back();
}

TEST_P(LetGo, ABallBouncesToTheSquareOfItsRestitution) {
  const double radius = 0.05, drop = 0.5, e = 0.7;
  scene::Scene scene = scene_of({ball(radius, Vector3d(0, 0, radius + drop), 0.3, e)}, GetParam(), 0.3);
  scene.bench_material.restitution = e;
  Simulation s = let_go(scene, 0.0, 3.0);
  double height = drop, top = 0.0, t = 0.18 + std::sqrt(2.0 * drop / g);
  for (int bounce = 1; bounce <= 3; ++bounce) {
    height *= e * e;
    const double half = std::sqrt(2.0 * height / g);
    // The top of each leap, when it should be there.
    s.advance_to(t + half);
    top = s.objects()[0].X_WO.translation().z() - radius;
    EXPECT_NEAR(top, height, 0.02 * height) << bounce;
    t += 2.0 * half;
  }
}

/// Exact for a ball: the normal velocity comes back as e, and friction stops its slip, or as much of it as it can.
TEST_P(LetGo, ABallThatSlidesAsItBouncesComesOffByPoissonsLaw) {
  const double radius = 0.05, drop = 0.3, vx = 1.5;
  for (const double e : {0.3, 0.6, 1.0}) {
    for (const double mu : {0.05, 0.5}) {
      scene::Scene scene = scene_of({ball(radius, Vector3d(0, 0, radius + drop), mu, e)}, GetParam(), mu);
      scene.bench_material.restitution = e;
      Simulation s = let_go(scene, vx, 1.0);
      const double start = s.objects()[0].V_WO_W.linear.x(), vn = std::sqrt(2.0 * g * drop);
      const double impact = 0.18 + vn / g, after = impact + 0.5 * e * vn / g;
      s.advance_to(after);
      const Twist& V = s.objects()[0].V_WO_W;
      const double braked = std::min(2.0 / 7.0 * start, mu * (1.0 + e) * vn);
      EXPECT_NEAR(V.linear.z(), e * vn - g * (s.time() - impact), 0.02 * e * vn) << e << ' ' << mu;
      EXPECT_NEAR(V.linear.x(), start - braked, 0.01 * start) << e << ' ' << mu;
      EXPECT_NEAR(V.angular.y() * radius, 2.5 * braked, 0.02 * start) << e << ' ' << mu;
    }
  }
}

TEST_P(LetGo, WhatTheContactsTellIsTheImpulseOfTheBench) {
  const double step = 0.02;
  scene::Body tilted = box("held", Vector3d(0.1, 0.08, 0.06), 1.0, Vector3d(0, 0, 0.2), 0.3);
  tilted.X_WO =
      make_transform(Vector3d(0, 0, 0.2), Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(1, 2, 0.5).normalized())));
  const Vector3d above(0, 0, 0.15);
  for (const scene::Body& body : {ball(0.05, above, 0.3), ball(0.05, above, 0.3, 0.7), tilted}) {
    scene::Scene scene = scene_of({body}, GetParam(), 0.3);
    scene.bench_material.restitution = body.material.restitution;
    Simulation s = let_go(scene, 0.3, 0.9, step);
    const double begin = s.time(), before = s.objects()[0].V_WO_W.linear.z();
    double told = 0.0;
    for (int i = 1; i <= 30; ++i) {
      s.advance_to(begin + step * i);
      for (const contact::ContactState& c : s.contacts()) told += c.impulse * c.n_W.z();
    }
    const double given = s.objects()[0].V_WO_W.linear.z() - before + g * (s.time() - begin);  // [N·s], of 1 kg
    ASSERT_GT(given, 2.0);
    EXPECT_NEAR(told, given, 0.01 * given) << body.material.restitution;
  }
}

TEST_P(LetGo, OnAnInclineItStaysBelowTheAngleOfFrictionAndSlidesAbove) {
  const double mu = 0.5;
  for (const double off : {-0.1, 0.1}) {
    const double angle = std::atan(mu) + off * M_PI / 180.0;
    const Matrix3d R = Eigen::AngleAxisd(angle, Vector3d::UnitY()).toRotationMatrix();  // downhill is +x
    scene::Body ramp = box("ramp", Vector3d(40.0, 1.0, 0.2), 0.0, Vector3d(0, 0, 15.0), mu);
    ramp.X_WO.linear() = R;
    scene::Body b = box("held", Vector3d(0.1, 0.1, 0.05), 1.0, Vector3d::Zero(), mu);
    b.X_WO.linear() = R;
    b.X_WO.translation() = ramp.X_WO * Vector3d(0, 0, 0.1 + 0.025 + 1e-6);
    SimulationSettings set;
    // A fork without effect: an object that it grasps and releases keeps its velocity and stays awake.
    set.fork.shape = rod::ShapeKind::bushing;
    set.fork.stiffness = {0.0, 0.0, 0.0};
    Simulation s(scene_of({ramp, b}, GetParam(), mu), set);
    const double duration = off < 0.0 ? 60.0 : 5.0,
                 waking = 0.14;  // s, shorter than it takes a slow one to fall asleep
    for (double t = 0.0; t < 0.2 + duration; t += 0.02) {
      s.push_stylus({t, pointing_down(b.X_WO.translation() + set.fork.length * Vector3d::UnitZ())});
    }
    s.push_button(0.0, true);
    s.push_button(0.1, false);
    s.advance_to(0.1);
    const Vector3d start = s.objects()[0].X_WO.translation();
    const Vector3d v = s.objects()[0].V_WO_W.linear;
    EXPECT_LT(v.norm(), off < 0.0 ? 1e-4 : 0.1);
    for (double t = 0.1 + waking; t < 0.1 + duration; t += waking) {
      if (off < 0.0) {
        s.push_button(t - 0.04, true);
        s.push_button(t - 0.02, false);
      }
      s.advance_to(t);
      ASSERT_FALSE(s.objects()[0].asleep) << t;
    }
    s.advance_to(0.1 + duration);
    const double slid = (s.objects()[0].X_WO.translation() - start).norm();
    if (off < 0.0) {
      EXPECT_LT(slid, 1e-4);
    } else {
      const double a = g * (std::sin(angle) - mu * std::cos(angle));
      EXPECT_NEAR(slid, 0.5 * a * duration * duration, 0.05 * 0.5 * a * duration * duration);
    }
  }
}

/// A body that tumbles freely, after `steps` steps of `h` [s].
motion::MotionState tumbled(const scene::Body& body, const Vector3d& w, double h, int steps) {
  bodies::FreeBody free(0, body, 0.0, RigidTransform::Identity(), {Vector3d::Zero(), w});
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(free.advance(h, Wrench()));
  return free.object();
}

TEST(FreeRotation, KeepsItsEnergyAndIsOfOrderFour) {
  scene::Body body = box("body", Vector3d::Ones(), 1.0, Vector3d::Zero(), 0.0);
  body.mass_properties.inertia_O = Vector3d(1e-3, 2e-3, 2.5e-3).asDiagonal();
  const Matrix3d& I = body.mass_properties.inertia_O;
  const Vector3d fast(20.0, 1.0, 15.0), slow = 0.1 * fast;
  const motion::MotionState end = tumbled(body, fast, 0.02, 500);
  const Vector3d w_O = end.X.linear().transpose() * end.velocity.angular;
  EXPECT_NEAR(w_O.dot(I * w_O), fast.dot(I * fast), 1e-6 * fast.dot(I * fast));
  EXPECT_LT((end.X.linear() * I * w_O - I * fast).norm(), 1e-12 * (I * fast).norm());
  const RigidTransform exact = tumbled(body, slow, 1.25e-3, 800).X;
  const double coarse = math::turn_between(tumbled(body, slow, 0.02, 50).X, exact).norm();
  const double fine = math::turn_between(tumbled(body, slow, 0.01, 100).X, exact).norm();
  EXPECT_GT(std::log2(coarse / fine), 3.7);
}

}  // namespace
}  // namespace spring_workbench::simulation::free_contact_test
