#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <string>

#include "named.h"
#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench {

/// A hand that moves on a cubic in position and in rotation vector.
inline motion::MotionSegment random_hand(double duration, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Vector3d(size * Vector3d(x, y, z));
  };
  motion::PoseSample a, b;
  a.X = make_transform(vector(0.1), Quaterniond(math::exp_so3(vector(1.0))));
  b.t = duration;
  b.X = make_transform(a.X.translation() + vector(0.5 * duration),
                       Quaterniond(a.X.linear() * math::exp_so3(vector(2.0 * duration))));
  const Vector3d v = vector(0.5), w = vector(2.0);
  return motion::MotionSegment(a, v, w, b, vector(0.5), vector(2.0));
}

/// A random held body and hand, gentle enough for the fork to stay far from its limits.
struct Case {
  dynamics::HeldBody held;
  motion::MotionSegment hand;
  double omega;  ///< undamped frequency of the stiffest mode [rad/s]
};

inline Case random_case(const std::string& shape, double damping_ratio, double duration, std::mt19937& random,
                        rod::DampingLaw damping_law = rod::DampingLaw::per_dof) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  dynamics::BodyInertia body;
  body.mass = std::pow(10.0, 3.0 * uniform(random));
  body.inertia_O = body.mass * Vector3d(0.0030, 0.0045, 0.0040 + 0.001 * uniform(random)).asDiagonal();
  const Vector3d turn(0.3 * uniform(random), 0.3 * uniform(random), uniform(random));
  const Vector3d grasp(0.03 * uniform(random), 0.03 * uniform(random), -0.05 + 0.02 * uniform(random));
  body.X_OE = make_transform(grasp, Quaterniond(math::exp_so3(turn)));
  dynamics::HeldBody held(rod::make_shape_model(test_support::shape_named(shape), 0.2), body, 9.81);
  const auto factor = [&] { return std::pow(10.0, 0.5 * uniform(random)); };
  rod::ForkSettings fork;
  fork.stiffness = {1500.0 * body.mass * factor(), 500.0 * body.mass * factor(), 5.0 * body.mass * factor()};
  fork.damping_ratio = {damping_ratio, damping_ratio, damping_ratio};
  fork.damping_law = damping_law;
  held.set_springs(fork);
  const rod::StrainVector rest = rod::StrainVector::Zero(held.size());
  const rod::StrainMatrix M = held.mass_matrix(0.0, rest);
  const Eigen::GeneralizedSelfAdjointEigenSolver<rod::StrainMatrix> modes(
      rod::StrainMatrix(held.stiffness().asDiagonal()), M);
  return {held, random_hand(duration, random), std::sqrt(modes.eigenvalues().maxCoeff())};
}

/// Whether the stiffest mode limits the steps of an integrator: true for all that are not made for stiff forks.
inline bool limited_by_stiffness(const std::string& integrator) {
  return integrator != "exponential" && integrator != "rosenbrock" && integrator != "implicit_euler" &&
         integrator != "paper";
}

/// Position error of the object [m], and angle times the body's radius of gyration.
inline double distance(const Case& c, double t, const dynamics::StrainState& a, const dynamics::StrainState& b) {
  const dynamics::HandleState f = c.held.state_at(c.hand, t);
  const RigidTransform A = c.held.object(f, a).X, B = c.held.object(f, b).X;
  return (A.translation() - B.translation()).norm() + 0.1 * math::log_so3(A.linear().transpose() * B.linear()).norm();
}

}  // namespace spring_workbench
