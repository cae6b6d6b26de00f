#include "spring_workbench/tools/probe.h"

#include <algorithm>

namespace spring_workbench::tools {
Probe::Probe(double length, const rod::ForkSettings& fork, const AxisHit& touched, double now)
    : length_(length),
      body_(touched.body),
      material_(*touched.material),
      since_(now),
      hand_(RigidTransform::Identity()) {
  set_springs(fork);
  touch(touched);
}

void Probe::touch(const AxisHit& touched) {
  depth_ = length_ - touched.distance;
  point_O_ = touched.point_O;
  normal_O_ = touched.normal_O;
}

void Probe::set_springs(const rod::ForkSettings& fork) {
  const double mass = body_ != nullptr && body_->movable ? body_->mass_properties.mass : 0.0;
  k_ = fork.stiffness.stretch;
  series_ = k_ / (1.0 + k_ / material_.stiffness);
  rod::ForkSettings in_series = fork;
  in_series.stiffness.stretch = series_;
  c_ = rod::stretch_damping(in_series, mass);
  ++version_;
}

template <typename S>
Probe::Touch<S> Probe::touch_of(const dynamics::RelativeMotion<S>& A_O) const {
  // Along z of the hand to the plane through the point with the normal, both fixed to the object.
  const math::Vec3<S> n = A_O.R_AB * math::vec3(normal_O_), p = A_O.p_AB + A_O.R_AB * math::vec3(point_O_);
  const S per_slope = 1.0 / n.z, distance = dot(n, p) * per_slope;
  Touch<S> at{};
  at.depth = length_ - distance;
  at.arm = math::Vec3<S>{S{}, S{}, distance} - A_O.p_AB;
  at.speed = A_O.v_AB + cross(A_O.w_AB, at.arm);
  at.rate = -(dot(n, at.speed) * per_slope);
  at.force = series_ * at.depth + c_ * at.rate;
  for (int i = 0; i < math::lanes<S>; ++i) {
    if (math::lane(at.depth, i) <= 0.0 || math::lane(at.force, i) <= 0.0) math::set_lane(at.force, i, 0.0);
  }
  return at;
}

template <typename S>
void Probe::pull_of(const dynamics::RelativeMotion<S>& A_O, dynamics::Pull<S>& pull) const {
  const Touch<S> at = touch_of(A_O);
  pull.force = {S{}, S{}, at.force};
  pull.moment = cross(at.arm, pull.force);
}

void Probe::pull(const double&, const dynamics::RelativeMotion<double>& A_O, dynamics::Pull<double>& pull) const {
  pull_of(A_O, pull);
}

void Probe::pull(const math::Pack&, const dynamics::RelativeMotion<math::Pack>& A_O,
                 dynamics::Pull<math::Pack>& pull) const {
  pull_of(A_O, pull);
}

dynamics::Coupling::Springs Probe::springs(double, const dynamics::RelativeMotion<double>& A_O) const {
  const Touch<double> at = touch_of(A_O);
  Springs s;
  if (at.depth <= 0.0) return s;
  s.energy = 0.5 * series_ * at.depth * at.depth;
  s.dissipated_power = -at.force * at.speed.z - series_ * at.depth * at.rate;
  if (at.force == 0.0) return s;
  const Vector3d axis = Vector3d::UnitZ();
  Vector6d direction;
  direction << axis, math::vector(at.arm).cross(axis);
  s.stiffness = series_ * direction * direction.transpose();
  s.damping = c_ * direction * direction.transpose();
  return s;
}

void Probe::follow(double t, const motion::MotionState& object) {
  const Touch<double> at = touch_of(dynamics::relative_motion(hand_.body_rate_state(t), object));
  depth_ = at.depth;
  force_ = at.force;
}

void Probe::press() { force_ = std::max(depth_, 0.0) * series_; }

void Probe::describe(const RigidTransform& X_WH, ToolState& state) const {
  const double indent = force_ / material_.stiffness, shortened = std::max(depth_ - indent, 0.0);
  const Vector3d push = force_ * X_WH.linear().col(2);
  state.touched = body_ != nullptr ? body_->name : "workbench";
  state.stretch = -shortened;
  state.X_WE = X_WH * Eigen::Translation3d(0.0, 0.0, length_ - shortened);
  state.strain[state.strain.size() - 1] = state.shape == rod::ShapeKind::bushing ? -shortened : -shortened / length_;
  state.tip_wrench_W.force = push;
  state.handle_wrench_H.force = -(X_WH.linear().transpose() * push);
  state.elastic_energy = elastic_energy();
  state.probe_damping = c_;
}

}  // namespace spring_workbench::tools
