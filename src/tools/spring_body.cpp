#include "spring_body.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/math/damped_oscillator.h"
#include "spring_workbench/tools/calibration.h"

namespace spring_workbench::tools {
namespace {

Vector3d direction(const Vector3d& d) { return d.norm() > no_length ? Vector3d(d.normalized()) : Vector3d(0, 0, -1); }

}  // namespace

SpringBody::SpringBody(std::size_t index, const scene::Body& body, double gravity, const RigidTransform& X_WO,
                       double rest_length, const rod::ForkSettings& fork)
    : mass_(body.mass_properties.mass),
      gravity_(gravity),
      rest_length_(rest_length),
      hand_(RigidTransform::Identity()),
      state_{0.0, bodies::FreeBody(index, body, gravity, X_WO, Twist())},
      inertia_O_(body.mass_properties.inertia_O) {
  set_springs(fork);
}

void SpringBody::set_hand(const motion::MotionSegment& hand, double t) {
  hand_ = hand;
  state_.t = t;
}

void SpringBody::set_springs(const rod::ForkSettings& fork) {
  k_ = fork.stiffness.stretch;
  c_ = rod::stretch_damping(fork, mass_);
}

rod::PerDof SpringBody::fitting_stiffness(const rod::ForkSettings& fork, double gravity, const ObjectGoal& goal) const {
  return {calibrated_spring(mass_, goal.sag * fork.length, gravity), fork.stiffness.bend, fork.stiffness.torsion};
}

Wrench SpringBody::spring_pull() const {
  const Span s = span();
  return {-k_ * (s.d.norm() - rest_length_) * direction(s.d), Vector3d::Zero()};
}

/// It can do no more than pull along its line, by another rest length.
void SpringBody::regrasp(const RigidTransform& X_WO, const Wrench& pull_W) {
  const Vector3d d = X_WO.translation() - hand_.at(state_.t).X.translation();
  if (k_ > 0.0) rest_length_ = std::max(d.norm() + pull_W.force.dot(direction(d)) / k_, least_rest_length);
}

SpringBody::Span SpringBody::span() const {
  const motion::MotionState hand = hand_.at(state_.t);
  const motion::MotionState o = object();
  return {o.X.translation() - hand.X.translation(), o.velocity.linear - hand.velocity.linear};
}

SpringBody::Linear SpringBody::linear(const Span& s) const {
  Linear a;
  a.d = s.d;
  a.n = direction(s.d);
  a.radial = k_ / mass_;
  a.alpha = 0.5 * c_ / mass_;
  a.transverse = s.d.norm() > rest_length_ ? a.radial * (1.0 - rest_length_ / s.d.norm()) : 0.0;
  return a;
}

Vector3d SpringBody::acceleration(const Span& s, const Vector3d& rest_W) const {
  const Vector3d n = direction(s.d);
  return rest_W - (k_ * (s.d.norm() - rest_length_) + c_ * n.dot(s.rate)) / mass_ * n;
}

Vector3d SpringBody::nonlinear_residual(const Linear& a, const Span& s, const Vector3d& rest_W) const {
  const Vector3d x = s.d - a.d;
  const double along = a.n.dot(x);
  return acceleration(s, rest_W) + (a.radial * along + 2.0 * a.alpha * a.n.dot(s.rate)) * a.n +
         a.transverse * (x - along * a.n);
}

SpringBody::Span SpringBody::respond(const Linear& a, const Span& s, double h, const Vector3d& nonlinear_residual) {
  const math::OscillatorStep along = math::damped_oscillator(a.alpha, a.radial, h);
  const math::OscillatorStep across = math::damped_oscillator(0.0, a.transverse, h);
  const double v = a.n.dot(s.rate), g = a.n.dot(nonlinear_residual);
  const Vector3d v_across = s.rate - v * a.n, g_across = nonlinear_residual - g * a.n;
  return {a.d + (along.xv * v + along.xg * g) * a.n + across.xv * v_across + across.xg * g_across,
          (along.vv * v + along.vg * g) * a.n + across.vv * v_across + across.vg * g_across};
}

bool SpringBody::advance(double h, const Wrench& contact_W) {
  const auto rest = [&](double t) {  // what accelerates beside the spring
    return Vector3d(contact_W.force / mass_ - gravity_ * Vector3d::UnitZ() - hand_.at(t).acceleration.linear);
  };
  const Span begin = span();
  const Linear a = linear(begin);
  const Vector3d at_begin = nonlinear_residual(a, begin, rest(state_.t));
  const Span middle = respond(a, begin, 0.5 * h, at_begin);
  const Span end = respond(a, begin, h, nonlinear_residual(a, middle, rest(state_.t + 0.5 * h)));
  State next = state_;
  if (!end.d.allFinite() || !end.rate.allFinite() || !next.free.advance(h, contact_W)) return false;
  const motion::MotionState hand = hand_.at(state_.t + h);
  next.free.set_motion_of_centre(hand.X.translation() + end.d, hand.velocity.linear + end.rate);
  next.t += h;
  state_ = next;
  estimates_.position = std::max(estimates_.position, (respond(a, begin, h, at_begin).d - end.d).norm());
  estimates_.omega_dt = std::max(estimates_.omega_dt, std::sqrt(a.radial) * h);
  return true;
}

bodies::SteppedBody::Response SpringBody::response(double h) const {
  Response response = state_.free.response(h);
  const Linear a = linear(span());
  const math::OscillatorStep along = math::damped_oscillator(a.alpha, a.radial, h),
                             across = math::damped_oscillator(0.0, a.transverse, h);
  const Matrix3d radial = a.n * a.n.transpose();
  response.displacement.topLeftCorner<3, 3>() =
      (across.xg * Matrix3d::Identity() + (along.xg - across.xg) * radial) / mass_;
  response.velocity.topLeftCorner<3, 3>() =
      (across.vg * Matrix3d::Identity() + (along.vg - across.vg) * radial) / mass_;
  return response;
}

bodies::Coupling SpringBody::coupling(double h, const RigidTransform& X_WO, const Matrix6d& mobility) const {
  const motion::MotionState hand = hand_.at(state_.t), next = hand_.at(state_.t + h);
  const Vector3d d = X_WO.translation() - hand.X.translation();
  const Vector3d n = direction(d);
  const double taut = d.norm() > rest_length_ ? k_ * (1.0 - rest_length_ / d.norm()) : 0.0;
  const double least = least_stiffness / (h * h * mobility(0, 0));
  const double along = std::max(k_ + c_ / h, least), across = std::max(taut, least);
  const Matrix3d radial = n * n.transpose();
  const Matrix3d compliance = radial / along + (Matrix3d::Identity() - radial) / across;
  bodies::Coupling c;
  c.directions.setZero(6, 3);
  c.directions.topRows<3>().setIdentity();
  c.compliance = compliance;
  const Vector3d moved = next.X.translation() - hand.X.translation();
  c.relaxed = moved - k_ * (d.norm() - rest_length_) / along * n;
  return c;
}

void SpringBody::follow(double h, const motion::MotionState& object, const Wrench&) {
  state_.free.set_motion(object);
  state_.t += h;
}

void SpringBody::block(double h) {
  state_.free.block(h);
  state_.t += h;
}

double SpringBody::elastic_energy() const {
  const double extension = span().d.norm() - rest_length_;
  return 0.5 * k_ * extension * extension;
}

void SpringBody::describe(bool, ToolState& state) const {
  const Span s = span();
  const Vector3d n = direction(s.d);
  const motion::MotionState o = object();
  const RigidTransform X_WH = hand_.at(state_.t).X;
  state.stretch = s.d.norm() - rest_length_;
  // Drawn straight from the hand to the object's centre.
  state.X_WH_proxy = X_WH;
  state.X_WH_proxy.linear() = Quaterniond::FromTwoVectors(X_WH.linear().col(2), n).toRotationMatrix() * X_WH.linear();
  state.X_WE = state.X_WH_proxy * Eigen::Translation3d(0.0, 0.0, s.d.norm());
  const double drawn = state.shape == rod::ShapeKind::bushing ? state.stretch : state.stretch / rest_length_;
  state.strain[state.strain.size() - 1] = drawn;
  state.tip_wrench_W.force = -(k_ * state.stretch + c_ * n.dot(s.rate)) * n;
  state.handle_wrench_H.force = -(X_WH.linear().transpose() * state.tip_wrench_W.force);
  state.elastic_energy = elastic_energy();
  const Vector3d w_O = o.X.linear().transpose() * o.velocity.angular;
  state.kinetic_energy = 0.5 * mass_ * o.velocity.linear.squaredNorm() + 0.5 * w_O.dot(inertia_O_ * w_O);
}

}  // namespace spring_workbench::tools
