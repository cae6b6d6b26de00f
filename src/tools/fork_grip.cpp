// Regrasping: the hand takes the fork at another pose while the fork holds an object.
#include <cmath>

#include "constants.h"
#include "fork_body.h"
#include "spring_workbench/math/singular_values.h"
#include "spring_workbench/stepping/find_strain.h"

namespace spring_workbench::tools {
namespace {

RigidTransform normalised(const RigidTransform& X) { return make_transform(X.translation(), Quaterniond(X.linear())); }

}  // namespace

Wrench ForkBody::spring_pull() const {
  Wrench springs = pull();
  if (held_.size() == 0) return springs;
  // The smallest of all wrenches equivalent to the dampers' generalised force; with six coordinates it is unique.
  const rod::StrainVector dampers = held_.damping() * state_.strain.q_dot;
  Matrix6d onto_coordinates = Matrix6d::Zero();
  onto_coordinates.topRows(held_.size()) = jacobian_W().transpose();
  Vector6d generalised = Vector6d::Zero();
  generalised.head(held_.size()) = -dampers;
  return to_wrench(to_vector(springs) - math::least_squares(onto_coordinates, generalised));
}

rod::StrainVector ForkBody::strain_under(const Wrench& pull_W, const Matrix3d& R_WO) {
  const rod::StrainVector present = state_.strain.q, K = held_.stiffness();
  if (present.size() == 0) return present;
  const rod::StrainVector mass = held_.mass_matrix(state_.t, present).diagonal();
  const Vector3d force_O = R_WO.transpose() * pull_W.force, moment_O = R_WO.transpose() * pull_W.moment;
  const dynamics::HandleState at_origin = held_.state_at(motion::MotionSegment(RigidTransform::Identity()), state_.t);
  const auto missing = [&](const rod::StrainVector& q) -> rod::StrainVector {
    const Matrix3d R_HO = held_.object(at_origin, {q, rod::StrainVector::Zero(q.size())}).X.linear();
    const Vector6d load = to_vector(Wrench{R_HO * force_O, R_HO * moment_O});
    rod::StrainVector f = -(held_.object_jacobian(state_.t, q).transpose() * load) - held_.elastic_force(state_.t, q);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      if (!(K[i] > 0.0)) f[i] = mass[i] * (present[i] - q[i]);  // without a spring: one of 1 rad/s holds it there
    }
    return f;
  };
  const stepping::FoundStrain under = stepping::find_strain(held_, state_.t, missing, present);
  if (!under.found) ++estimates_.fallback;
  return under.found ? under.q : present;
}

void ForkBody::regrasp(const RigidTransform& X_WO, const Wrench& pull_W) {
  state_.strain.q = strain_under(pull_W, X_WO.linear());
  const dynamics::HandleState at_origin = held_.state_at(motion::MotionSegment(RigidTransform::Identity()), state_.t);
  const RigidTransform X_HO = held_.object(at_origin, state_.strain).X;
  const RigidTransform X_HH = hand_pose().inverse() * X_WO * X_HO.inverse();
  take_hand(hand_.of_frame(normalised(X_HH)));
  X_SH_ = normalised(X_SH_ * X_HH);
  state_.proxy = motion::Proxy();
  state_.pull_W.reset();
  state_.stepping = stepping::StepControl::Memory();
  sleep_ = Sleep();
}

RigidTransform ForkBody::slip(double h, const motion::MotionState& object, const Wrench& at_tip_W) {
  const Vector3d lever = object.X.linear() * held_.body().X_OE.translation();
  const Wrench pull_W{at_tip_W.force, at_tip_W.moment + lever.cross(at_tip_W.force)};
  const rod::StrainVector q = strain_under(pull_W, object.X.linear());
  state_.strain.q = q + std::exp(-h / return_time) * (state_.strain.q - q);
  const dynamics::HandleState at_origin = held_.state_at(motion::MotionSegment(RigidTransform::Identity()), state_.t);
  const RigidTransform X_HO = held_.object(at_origin, state_.strain).X;
  state_.t += h;
  state_.proxy = motion::Proxy();
  state_.pull_W = pull_W;
  state_.stepping = stepping::StepControl::Memory();
  sleep_ = Sleep();
  const RigidTransform X_WH = normalised(object.X * X_HO.inverse());
  take_hand(motion::MotionSegment(X_WH));
  take_twist(object.velocity);
  return normalised(X_WH * X_SH_.inverse());
}

}  // namespace spring_workbench::tools
