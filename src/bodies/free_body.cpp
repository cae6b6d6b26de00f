#include "spring_workbench/bodies/free_body.h"

#include <Eigen/LU>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::bodies {
FreeBody::FreeBody(std::size_t index, const scene::Body& body, double gravity, const RigidTransform& X_WO,
                   const Twist& V_WO_W)
    : index_(index),
      mass_(body.mass_properties.mass),
      inertia_O_(body.mass_properties.inertia_O),
      inverse_inertia_O_(inertia_O_.inverse()),
      gravity_(gravity) {
  state_.X_WO = X_WO;
  const Matrix3d& R = X_WO.linear();
  state_.velocity = V_WO_W.linear;
  state_.angular_momentum = R * inertia_O_ * R.transpose() * V_WO_W.angular;
}

Vector3d FreeBody::angular_velocity(const Matrix3d& R_WO, const Vector3d& angular_momentum) const {
  return R_WO * (inverse_inertia_O_ * (R_WO.transpose() * angular_momentum));
}

motion::MotionState FreeBody::object() const {
  motion::MotionState s;
  s.X = state_.X_WO;
  s.velocity.linear = state_.velocity;
  s.velocity.angular = angular_velocity(state_.X_WO.linear(), state_.angular_momentum);
  return s;
}

bool FreeBody::advance(double h, const Wrench& contact_W) {
  State next = state_;
  const Vector3d acceleration = contact_W.force / mass_ - gravity_ * Vector3d::UnitZ();
  next.X_WO.translation() += h * state_.velocity + 0.5 * h * h * acceleration;
  next.velocity += h * acceleration;
  // The momentum is exact; the attitude follows by a Runge–Kutta method of rotations of order four [CMO03].
  const double turn = h * angular_velocity(state_.X_WO.linear(), state_.angular_momentum).norm();
  const int substeps = 1 + static_cast<int>(std::min(turn / max_turn_per_substep, static_cast<double>(max_substeps)));
  const double dt = h / substeps;
  Matrix3d R = state_.X_WO.linear();
  for (int i = 0; i < substeps; ++i) {
    const Vector3d L0 = state_.angular_momentum + i * dt * contact_W.moment;
    const Vector3d L1 = L0 + 0.5 * dt * contact_W.moment, L2 = L0 + dt * contact_W.moment;
    const auto turned = [&](const Vector3d& w, const Matrix3d& from) { return Matrix3d(math::exp_so3(dt * w) * from); };
    const Vector3d w0 = angular_velocity(R, L0);
    const Matrix3d half = turned(0.5 * w0, R);
    const Vector3d w1 = angular_velocity(half, L1);
    const Vector3d w2 = angular_velocity(turned(0.5 * w1, R), L1);
    const Vector3d w3 = angular_velocity(turned(w2 - 0.5 * w0, half), L2);
    R = turned((2.0 * (w1 + w2) + 3.0 * w3 - w0) / 12.0, turned((3.0 * w0 + 2.0 * (w1 + w2) - w3) / 12.0, R));
  }
  next.X_WO.linear() = Quaterniond(R).normalized().toRotationMatrix();
  next.angular_momentum += h * contact_W.moment;
  if (!next.X_WO.matrix().allFinite() || !next.velocity.allFinite() || !next.angular_momentum.allFinite()) return false;
  state_ = next;
  return true;
}

void FreeBody::correct(double h, const Wrench& change_W) {
  const Vector3d turn = 0.5 * h * h * angular_velocity(state_.X_WO.linear(), change_W.moment);
  state_.X_WO.translation() += 0.5 * h * h / mass_ * change_W.force;
  state_.X_WO.linear() = Quaterniond(math::exp_so3(turn) * state_.X_WO.linear()).normalized().toRotationMatrix();
  state_.velocity += h / mass_ * change_W.force;
  state_.angular_momentum += h * change_W.moment;
}

Matrix6d FreeBody::mobility() const {
  const Matrix3d& R = state_.X_WO.linear();
  return spatial_matrix(1.0 / mass_, R * inverse_inertia_O_ * R.transpose());
}

void FreeBody::add_impulse(const Wrench& impulse_W) {
  state_.velocity += impulse_W.force / mass_;
  state_.angular_momentum += impulse_W.moment;
}

void FreeBody::block(double) {
  state_.velocity.setZero();
  state_.angular_momentum.setZero();
}

}  // namespace spring_workbench::bodies
