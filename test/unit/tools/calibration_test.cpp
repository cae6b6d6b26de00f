#include "spring_workbench/tools/calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double length = 0.2, gravity = 9.81;
const Vector3d box_size(0.1, 0.06, 0.04);  // [m]

/// A box, held by a fork along its −z axis with the tip at `p_OE`.
BodyInertia box(double mass, const Vector3d& p_OE) {
  const Vector3d s = box_size.cwiseAbs2() * mass / 12.0;
  BodyInertia body{mass, Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y()).asDiagonal(),
                   RigidTransform::Identity()};
  body.X_OE.translation() = p_OE;
  return body;
}

const std::vector<Vector3d> grasps = {Vector3d::Zero(), Vector3d(0.05, 0.0, 0.0), Vector3d(0.0, 0.0, -0.02),
                                      Vector3d(0.05, 0.03, 0.0), Vector3d(0.05, 0.03, -0.02)};

/// The body on the calibrated fork, where it comes to rest by itself: no solver of equilibria here.
struct Held {
  Held(const BodyInertia& body, const ForkCalibration& fork, const Vector3d& turn)
      : held(make_shape_model("linear", length), body, gravity), integrator(make_integrator("exponential")), hand(pose(turn)) {
    const int size = held.shape().size();
    state = {StrainVector::Zero(size), StrainVector::Zero(size)};
    held.set_springs_and_dampers(fork.stiffness, fork.damping);
    state = held.set_dofs({true, true, true}, 0.0, 1.0, state);
  }
  static RigidTransform pose(const Vector3d& turn) {
    RigidTransform X = RigidTransform::Identity();
    X.linear() = exp_so3(turn);
    return X;
  }
  void run(double seconds) {
    for (double end = t + seconds; t < end - 1e-9; t += 0.005) integrator->step(held, MotionSegment(hand), t, 0.005, state);
  }
  double extension() const { return held.shape().extension(state.q); }
  double deflection() const { return held.shape().section(state.q, length).translation().head<2>().norm(); }

  HeldBody held;
  std::unique_ptr<Integrator> integrator;
  RigidTransform hand;
  StrainState state;
  double t = 0.0;
};

const Vector3d hanging(pi, 0.0, 0.0), level(0.0, -0.5 * pi, 0.0);

TEST(Calibration, StaticSagIsTheSetPartOfTheLengthOverTwelveDecadesOfMassWhereverTheGraspIs) {
  const CalibrationGoal goal;
  for (double mass = 1e-6; mass < 2e6; mass *= 1e4) {
    for (const Vector3d& p_OE : grasps) {
      const BodyInertia body = box(mass, p_OE);
      const ForkCalibration fork = calibrated_fork("linear", length, body, gravity, goal);
      Held down(body, fork, hanging), across(body, fork, level);
      down.run(3.0);
      across.run(3.0);
      EXPECT_NEAR(down.extension(), goal.sag * length, 0.01 * goal.sag * length) << mass << ": " << p_OE.transpose();
      EXPECT_NEAR(across.deflection(), goal.sag * length, 0.01 * goal.sag * length) << mass << ": " << p_OE.transpose();
    }
  }
}

/// Time after which the coordinate stays within 2 % of where it was let go, in a motion without gravity.
double settling_time(const BodyInertia& body, const ForkCalibration& fork, const StrainVector& q) {
  HeldBody held(make_shape_model("linear", length), body, 0.0);
  held.set_springs_and_dampers(fork.stiffness, fork.damping);
  const StrainState zero{StrainVector::Zero(6), StrainVector::Zero(6)};
  StrainState state = held.set_dofs({true, true, true}, 0.0, 1.0, zero);
  state.q = q;
  const auto integrator = make_integrator("exponential");
  const MotionSegment hand{RigidTransform::Identity()};
  constexpr double h = 0.002;
  double settled = 0.0;
  for (double t = 0.0; t < 2.0; t += h) {
    integrator->step(held, hand, t, h, state);
    if (state.q.norm() > 0.02 * q.norm()) settled = t + h;
  }
  return settled;
}

TEST(Calibration, EveryDirectionSettlesAlike) {
  const BodyInertia body = box(1.0, Vector3d::Zero());
  const ForkCalibration fork = calibrated_fork("linear", length, body, gravity);
  HeldBody held(make_shape_model("linear", length), body, 0.0);
  held.set_springs_and_dampers(fork.stiffness, fork.damping);
  const StrainState zero{StrainVector::Zero(6), StrainVector::Zero(6)};
  held.set_dofs({true, true, true}, 0.0, 1.0, zero);
  // The static shape under a small force or moment along each direction.
  std::vector<StrainVector> shapes;
  const auto J = held.object_jacobian(0.0, zero.q);
  for (const int direction : {0, 1, 2, 5}) {
    Eigen::Matrix<double, 6, 1> load = Eigen::Matrix<double, 6, 1>::Zero();
    load[direction] = direction < 3 ? 0.01 : 1e-4;
    shapes.push_back((J.transpose() * load).cwiseQuotient(held.stiffness()));
  }
  const double omega = std::sqrt(gravity / (CalibrationGoal().sag * length));
  const double critical = 5.834 / omega;  // (1 + ωt) exp(−ωt) = 0.02
  for (const StrainVector& q : shapes) EXPECT_NEAR(settling_time(body, fork, q), critical, 0.05 * critical) << q.transpose();
}

TEST(Calibration, NoLoadNoGravityStaysPositive) {
  const ForkCalibration fork = calibrated_fork("linear", length, box(1.0, Vector3d::Zero()), 0.0);
  EXPECT_GT(fork.stiffness.stretch, 0.0);
  EXPECT_GT(fork.stiffness.torsion, 0.0);
}

TEST(Calibration, LengthGrowsWithTheObjectAndNotWithItsMass) {
  const double one = calibrated_length(box(1.0, Vector3d::Zero()));
  EXPECT_NEAR(calibrated_length(box(1e6, Vector3d::Zero())), one, 1e-12);
  BodyInertia large = box(1.0, Vector3d::Zero());
  large.inertia_O *= 4.0;
  EXPECT_NEAR(calibrated_length(large), 2.0 * one, 1e-12);
}

}  // namespace
}  // namespace spring_workbench
