#include "spring_workbench/tools/probe.h"

#include <algorithm>
#include <limits>

#include "constants.h"

namespace spring_workbench::tools {
Probe::Probe(double length, const rod::ForkSettings& fork, const InFront& touched)
    : length_(length), body_(touched.body), material_(*touched.material), hand_(RigidTransform::Identity()) {
  set_springs(fork);
  touch(touched);
}

void Probe::set_springs(const rod::ForkSettings& fork) {
  const double mass = body_ != nullptr && body_->movable ? body_->mass_properties.mass : 0.0;
  k_ = fork.stiffness.stretch;
  c_ = rod::stretch_damping(fork, mass);
}

void Probe::set_hand(const motion::MotionSegment& hand, double t) {
  hand_ = hand;
  state_.t = t;
}

RigidTransform Probe::tip(const RigidTransform& X_WH) const {
  return X_WH * Eigen::Translation3d(0.0, 0.0, length_ - state_.depth);
}

bodies::Coupling Probe::coupling(double h, const RigidTransform& X_WO, const Matrix6d& mobility) const {
  const motion::MotionState hand = hand_.at(state_.t), next = hand_.at(state_.t + h);
  const RigidTransform X_WE = tip(hand.X);
  const Vector3d n = X_WE.linear().col(2);
  bodies::Coupling c;
  c.pushes_only = true;
  c.directions.resize(6, 1);
  c.directions << n, (X_WE.translation() - X_WO.translation()).cross(n);
  // Spring and damper of the probe, and in series with both the material: f = at_once + stiffness · (further depth).
  const double own = k_ + c_ / h;
  const double series = 1.0 + own / material_.stiffness;
  const double least = least_stiffness / (h * h * mobility(0, 0));
  const double stiffness = std::max(own / series, least);
  const double at_once = (k_ * state_.depth + c_ * state_.indent / h) / series;
  c.compliance = bodies::Coupling::Matrix::Constant(1, 1, 1.0 / stiffness);
  const double advance = n.dot(tip(next.X).translation() - X_WE.translation());
  c.relaxed = bodies::Coupling::Vector::Constant(1, at_once / stiffness + advance);
  return c;
}

void Probe::follow(double h, const motion::MotionState& object, const Wrench& pull_W) {
  const motion::MotionState hand = hand_.at(state_.t), next = hand_.at(state_.t + h);
  const RigidTransform X_WE = tip(hand.X);
  const Vector3d n = X_WE.linear().col(2);
  const Vector3d arm = X_WE.translation() - (object.X.translation() - h * object.velocity.linear);
  const Vector3d yielded = h * (object.velocity.linear + object.velocity.angular.cross(arm));
  state_.depth += n.dot(tip(next.X).translation() - X_WE.translation() - yielded);
  state_.force = pull_W.force.dot(n);
  state_.indent = state_.force / material_.stiffness;
  state_.t += h;
}

double Probe::elastic_energy() const {
  const double shortened = state_.depth - state_.indent;
  return 0.5 * k_ * shortened * shortened + 0.5 * state_.force * state_.indent;
}

void Probe::press() {
  state_.force = std::max(state_.depth, 0.0) * k_ / (1.0 + k_ / material_.stiffness);
  state_.indent = state_.force / material_.stiffness;
}

void Probe::describe(const RigidTransform& X_WH, ToolState& state) const {
  const double shortened = state_.depth - state_.indent;
  const Vector3d push = state_.force * X_WH.linear().col(2);
  state.touched = body_ != nullptr ? body_->name : "workbench";
  state.stretch = -shortened;
  state.X_WE = X_WH * Eigen::Translation3d(0.0, 0.0, length_ - shortened);
  state.strain[state.strain.size() - 1] = state.shape == rod::ShapeKind::bushing ? -shortened : -shortened / length_;
  state.tip_wrench_W.force = push;
  state.handle_wrench_H.force = -(X_WH.linear().transpose() * push);
  state.elastic_energy = elastic_energy();
  if (!(state_.force > 0.0)) return;
  // What the user can know: the force, how far the tip has gone, and the probe's own stiffness.
  const double gave = state_.depth - state_.force / k_;
  constexpr double rigid = std::numeric_limits<double>::infinity();
  state.material_stiffness = gave > no_give * state_.depth ? state_.force / gave : rigid;
  state.material_stiffness_uncertainty =
      state.material_stiffness * state.material_stiffness * position_uncertainty / state_.force;
}

}  // namespace spring_workbench::tools
