#include "spring_workbench/bodies/free_motion.h"

#include <gtest/gtest.h>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::bodies {
namespace {

scene::Body brick() {
  scene::Body body;
  body.mass_properties.mass = 2.0;
  body.mass_properties.inertia_O = Vector3d(0.01, 0.03, 0.035).asDiagonal();
  return body;
}

RigidTransform tilted() {
  RigidTransform X = RigidTransform::Identity();
  X.translation() = Vector3d(0.1, -0.2, 0.3);
  X.linear() = math::exp_so3(Vector3d(0.3, -1.1, 0.7));
  return X;
}

TEST(FreeMotion, IsAParabolaUnderAConstantForce) {
  FreeMotion m;
  m.start_W.linear = {0.5, -0.3, 1.0};
  m.load_W.force = {1.0, 2.0, -19.62};
  m.push_W.linear = {0.0, 0.0, 1e-5};
  const scene::Body body = brick();
  const double h = 0.02;
  const motion::MotionState end = moved(m, body, tilted(), h);
  const Vector3d a = m.load_W.force / body.mass_properties.mass;
  const Vector3d way = h * m.start_W.linear + 0.5 * h * h * a + m.push_W.linear;
  EXPECT_LT((end.X.translation() - tilted().translation() - way).norm(), 1e-15);
  EXPECT_LT((end.velocity.linear - m.start_W.linear - h * a).norm(), 1e-14);  // what is undone is no speed
}

TEST(FreeMotion, KeepsItsAngularMomentumWhenNothingTouchesIt) {
  FreeMotion m;
  m.mean = true;
  m.start_W.angular = {3.0, -20.0, 35.0};
  const scene::Body body = brick();
  const auto momentum = [&](const RigidTransform& X, const Vector3d& w) {
    return Vector3d(X.linear() * body.mass_properties.inertia_O * X.linear().transpose() * w);
  };
  const motion::MotionState end = moved(m, body, tilted(), 0.02);
  const Vector3d L = momentum(tilted(), m.start_W.angular);
  EXPECT_LT((momentum(end.X, end.velocity.angular) - L).norm(), 1e-13 * L.norm());
  EXPECT_EQ(path_error(m, 0.1, 0.02), 0.0);
}

TEST(FreeMotion, ThePathsErrorGoesWithTheSquareOfTheStep) {
  const Vector3d acceleration(0.0, 0.0, -9.81), spin(0.0, 2.0, 0.0);
  const double radius = 0.05;
  const auto error = [&](double h, bool mean) {
    FreeMotion m;
    m.mean = mean;
    m.is_pressed = true;
    m.start_W.angular = spin;
    m.change_W.linear = h * acceleration;
    return path_error(m, radius, h);
  };
  for (const double h : {1e-3, 2e-3, 2e-2}) {
    EXPECT_NEAR(error(h, false), 0.5 * h * h * acceleration.norm(), 1e-15);
    EXPECT_NEAR(error(h, true), 0.5 * h * h * spin.squaredNorm() * radius, 1e-15);
  }
}

}  // namespace
}  // namespace spring_workbench::bodies
