#include "spring_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "constants.h"
#include "spring_workbench/math/moving_frames.h"
#include "spring_workbench/tools/calibration.h"

namespace spring_workbench::tools {
namespace {

Vector3d direction(const Vector3d& d) { return d.norm() > no_length ? Vector3d(d.normalized()) : Vector3d(0, 0, -1); }

}  // namespace

void SpringCoupling::set(double stiffness, double damping) {
  k_ = stiffness;
  c_ = damping;
  ++version_;
}

void SpringCoupling::set_rest_length(double length) {
  rest_length_ = length;
  ++version_;
}

template <typename S>
struct SpringCoupling::Span {
  math::Vec3<S> n;
  S length, extension, rate;
};

template <typename S>
SpringCoupling::Span<S> SpringCoupling::span(const dynamics::RelativeMotion<S>& A_O) const {
  const S squared = dot(A_O.p_AB, A_O.p_AB);
  Span<S> s{};
  for (int i = 0; i < math::lanes<S>; ++i) {
    math::set_lane(s.length, i, std::max(std::sqrt(math::lane(squared, i)), no_length));
  }
  s.n = (1.0 / s.length) * A_O.p_AB;
  s.extension = s.length - rest_length_;
  s.rate = dot(s.n, A_O.v_AB);
  return s;
}

template <typename S>
void SpringCoupling::pull_of(const dynamics::RelativeMotion<S>& A_O, dynamics::Pull<S>& pull) const {
  const Span<S> s = span(A_O);
  pull.force = -(k_ * s.extension + c_ * s.rate) * s.n;
  pull.moment = math::zero<S>();
}

void SpringCoupling::pull(const double&, const dynamics::RelativeMotion<double>& A_O,
                          dynamics::Pull<double>& pull) const {
  pull_of(A_O, pull);
}

void SpringCoupling::pull(const math::Pack&, const dynamics::RelativeMotion<math::Pack>& A_O,
                          dynamics::Pull<math::Pack>& pull) const {
  pull_of(A_O, pull);
}

dynamics::Coupling::Springs SpringCoupling::springs(double, const dynamics::RelativeMotion<double>& A_O) const {
  const Span<double> s = span(A_O);
  const Vector3d n = math::vector(s.n);
  const Matrix3d along = n * n.transpose();
  // Under tension it also has a transverse stiffness.
  const double across = std::max(k_ * s.extension / s.length, 0.0);
  Springs springs;
  springs.stiffness.topLeftCorner<3, 3>() = k_ * along + across * (Matrix3d::Identity() - along);
  springs.damping.topLeftCorner<3, 3>() = c_ * along;
  springs.energy = 0.5 * k_ * s.extension * s.extension;
  springs.dissipated_power = c_ * s.rate * s.rate;
  return springs;
}

dynamics::HeldBody unheld(const scene::Body& body, double gravity) {
  const scene::MassProperties& of_body = body.mass_properties;
  return dynamics::HeldBody(rod::make_shape_model(rod::ShapeKind::bushing, frame_distance),
                            {of_body.mass, of_body.inertia_O, RigidTransform::Identity()}, gravity);
}

motion::MotionSegment frame_at_rest(const RigidTransform& X_WO) {
  return motion::MotionSegment(X_WO * Eigen::Translation3d(0.0, 0.0, -frame_distance));
}

SpringBody::SpringBody(std::size_t index, const scene::Body& body, double gravity, const RigidTransform& X_WO,
                       stepping::StepControl control, double t, double rest_length, const rod::ForkSettings& fork)
    : ForkBody(index, unheld(body, gravity), std::move(control), t, RigidTransform::Identity()),
      spring_(rest_length, t),
      rest_(frame_at_rest(X_WO)),
      hand_(RigidTransform::Identity()) {
  ForkBody::set_hand(rest_, t);
  set_springs(fork);
  lead({});
}

void SpringBody::lead(const std::vector<dynamics::Attached>& others) {
  std::vector<dynamics::Attached> all{{&spring_, &hand_}};
  all.insert(all.end(), others.begin(), others.end());
  held().attach(all);
}

void SpringBody::follow(double t, const ToolHold&, const motion::MotionState& object) {
  ForkBody::set_hand(rest_, t);
  const RigidTransform X_HO = rest_.at(t).X.inverse() * object.X;
  const rod::TipFit<double> fit(held().shape(), math::mat3x3(X_HO.linear()), math::vec3(X_HO.translation()),
                                math::zero<double>(), math::zero<double>(), strain().q.data());
  set_strain({Eigen::Map<const Vector6d>(fit.q), strain().q_dot});
  take_twist(object.velocity);
}

void SpringBody::set_hand(const motion::MotionSegment& hand, double t) {
  ForkBody::set_hand(rest_, t);
  hand_ = hand;
  slipped_W_.reset();
}

void SpringBody::set_springs(const rod::ForkSettings& fork) {
  spring_.set(fork.stiffness.stretch, rod::stretch_damping(fork, held().body().mass));
}

rod::PerDof SpringBody::fitting_stiffness(const rod::ForkSettings& fork, double gravity, const ObjectGoal& goal) const {
  return {calibrated_spring(held().body().mass, goal.sag * fork.length, gravity), fork.stiffness.bend,
          fork.stiffness.torsion};
}

SpringBody::Reading SpringBody::reading() const {
  const motion::BodyRateState A = hand_.body_rate_state(time());
  const motion::MotionState o = object();
  const dynamics::RelativeMotion<double> A_O = dynamics::relative_motion(A, o);
  dynamics::Pull<double> pull{};
  spring_.pull(time(), A_O, pull);
  return {o.X.translation() - A.X.translation(),
          {A.X.linear() * math::vector(pull.force), Vector3d::Zero()},
          spring_.springs(time(), A_O)};
}

Wrench SpringBody::spring_pull() const {
  const Vector3d d = reading().d;
  return {-spring_.stiffness() * (d.norm() - spring_.rest_length()) * direction(d), Vector3d::Zero()};
}

void SpringBody::regrasp(const RigidTransform& X_WO, const Wrench& pull_W) {
  const Vector3d d = X_WO.translation() - hand_.at(time()).X.translation();
  const double k = spring_.stiffness();
  if (k > 0.0) spring_.set_rest_length(std::max(d.norm() + pull_W.force.dot(direction(d)) / k, min_rest_length));
}

RigidTransform SpringBody::slip(double h, const motion::MotionState& object, const Wrench& at_tip_W) {
  const Vector3d d = reading().d, force = at_tip_W.force;
  const double present = d.norm() - spring_.rest_length(), k = spring_.stiffness();
  const double side = std::copysign(1.0, -force.dot(direction(d)));  // −1: compression
  const double goal = k > 0.0 ? side * force.norm() / k : present;
  const double length = spring_.rest_length() + goal + std::exp(-h / return_time) * (present - goal);
  RigidTransform X_WS = hand_.at(time()).X;
  X_WS.translation() = object.X.translation() + length * side * force.normalized();
  follow(time() + h, *this, object);
  hand_ = motion::MotionSegment(X_WS);
  slipped_W_ = force;
  return X_WS;
}

void SpringBody::archive(math::StateArchive& state) {
  ForkBody::archive(state);
  state(spring_, rest_, hand_, slipped_W_);
}

void SpringBody::describe(bool, ToolState& state) const {
  describe_bound(state);
  const Reading now = reading();
  const Vector3d n = direction(now.d);
  const motion::MotionState o = object();
  const motion::MotionState handle = hand_.at(time());
  const RigidTransform& X_WH = handle.X;
  const Vector3d v = (o.velocity.linear - handle.velocity.linear) / std::max(now.d.norm(), no_length);
  const Vector3d w = math::aligned_rate(X_WH.linear(), handle.velocity.angular, n, v - n * n.dot(v));
  state.V_WE_W = {o.velocity.linear, w};
  state.stretch = now.d.norm() - spring_.rest_length();
  // Drawn straight from the hand to the object's centre.
  state.X_WH = state.X_WH_proxy = X_WH;
  state.X_WH_proxy.linear() = math::shortest_rotation(X_WH.linear().col(2), n) * X_WH.linear();
  state.X_WE = state.X_WH_proxy * Eigen::Translation3d(0.0, 0.0, now.d.norm());
  const double drawn = state.shape == rod::ShapeKind::bushing ? state.stretch : state.stretch / spring_.rest_length();
  state.strain[state.strain.size() - 1] = drawn;
  state.tip_wrench_W.force = slipped_W_.value_or(now.pull_W.force);
  state.handle_wrench_H.force = -(X_WH.linear().transpose() * state.tip_wrench_W.force);
  state.elastic_energy = now.springs.energy;
  state.kinetic_energy = held().kinetic_energy(o.velocity, o.X.linear());
}

}  // namespace spring_workbench::tools
