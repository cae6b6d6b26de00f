#include "fork_body.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "constants.h"
#include "spring_workbench/math/moving_frames.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::tools {
ForkBody::ForkBody(std::size_t index, dynamics::HeldBody held, stepping::StepControl control, double t,
                   const RigidTransform& X_SH)
    : index_(index),
      held_(std::move(held)),
      coupling_(held_, t),
      control_(std::move(control)),
      X_SH_(X_SH),
      hand_(RigidTransform::Identity()) {
  state_.t = t;
  state_.strain = held_.zero_state();
}

void ForkBody::set_hand(const motion::MotionSegment& hand, double t) {
  const bool as_stylus = X_SH_.matrix() == RigidTransform::Identity().matrix();
  take_hand(as_stylus ? hand : hand.of_frame(X_SH_));
  state_.t = t;
}

void ForkBody::set_load(const Wrench& load_W) {
  if (is_zero(load_W - load_W_)) return;
  held_.set_load(held_.load() - (load_W_ - load_W));
  load_W_ = load_W;
  sleep_ = Sleep();
}

RigidTransform ForkBody::hand_pose() const { return hand_.at(state_.t).X; }

dynamics::HandleState ForkBody::handle() const {
  const motion::Proxy& proxy = state_.proxy;
  return proxy.behind() ? held_.state_at(proxy.motion(hand_, state_.t), state_.t) : held_.state_at(hand_, state_.t);
}

motion::MotionState ForkBody::object() const {
  const auto is_known = [this](const Known& k) {
    return k.t == state_.t && k.version == held_.version() && k.strain.q == state_.strain.q &&
           k.strain.q_dot == state_.strain.q_dot && k.proxy == state_.proxy;
  };
  if (!known_ || !is_known(*known_)) {
    known_ = {state_.t, held_.version(), state_.strain, state_.proxy, held_.object(handle(), state_.strain)};
  }
  return known_->object;
}

motion::MotionState ForkBody::object_with_acceleration() const {
  const dynamics::HandleState h = handle();
  if (held_.size() == 0) {
    const rod::StrainVector none(0);
    return held_.object(h, state_.strain, &none);
  }
  const rod::StrainVector a = held_.acceleration(h, state_.strain.q, state_.strain.q_dot);
  return held_.object(h, state_.strain, &a);
}

Matrix6d ForkBody::rigid_mobility() const {
  if (yields_everywhere()) return Matrix6d::Zero();
  const Matrix3d R = object().X.linear();
  Matrix6d P = spatial_matrix(1.0 / held_.body().mass, R * held_.body().inertia_O.inverse() * R.transpose());
  P -= strain_mobility();
  if (const rod::StrainMatrix& stops = load_response_.stops(); stops.cols() > 0) {
    const rod::StrainMatrix by_stops = inverse_mass() * stops;
    const auto lost = (jacobian_W() * by_stops).eval();
    P += lost * (stops.transpose() * by_stops).llt().solve(lost.transpose());
  }
  return P;
}

Matrix6d ForkBody::proxy_compliance(double h) const {
  return compliance_time * compliance_time * (1.0 - std::exp(-h / return_time)) * rigid_mobility();
}

RigidTransform ForkBody::proxy_response(double h, const Wrench& contact_W) const {
  const Vector6d motion = proxy_compliance(h) * to_vector(contact_W);
  const Vector3d centre = object().X.translation();
  RigidTransform X = RigidTransform::Identity();
  X.linear() = math::exp_so3(motion.tail<3>());
  X.translation() = centre - X.linear() * centre + motion.head<3>();
  return X;
}

RigidTransform ForkBody::next_offset(double h, const Wrench& contact_W) const {
  const RigidTransform reduced_to = state_.proxy.reduced_to(std::exp(-h / return_time));
  return yields_everywhere() || is_zero(contact_W) ? reduced_to : proxy_response(h, contact_W) * reduced_to;
}

bool ForkBody::advance(double h, const Wrench& contact_W) {
  const RigidTransform offset = next_offset(h, contact_W);
  const bool as_hand = !state_.proxy.behind() && offset.matrix() == RigidTransform::Identity().matrix();
  const Twist rate = as_hand ? Twist() : state_.proxy.rate_to(offset, hand_.at(state_.t + h).X.translation(), h);
  const motion::MotionSegment motion = as_hand ? hand_ : state_.proxy.motion(hand_, state_.t, h, offset, rate);
  dynamics::StrainState next = state_.strain;
  held_.set_load(held_.size() > 0 ? math::sum(contact_W, load_W_) : load_W_);
  if (held_.size() > 0) {
    const stepping::ControlledStep step = control_.advance(held_, motion, state_.t, h, next, state_.stepping);
    if (!step.accepted) return false;
    trial_ = {step.position_error, step.angle_error, step.omega_dt,     step.steps - 1, step.substeps,
              step.stops,          step.fallback,    step.energy_error, step.bounds};
    added_ = step.energy_added;
  }
  load_response_.begin_step(held_.size());
  state_.t += h;
  state_.strain = next;
  state_.pull_W.reset();
  state_.proxy.place(offset, rate);
  if (held_.returning() && held_.drop_finished_returns(state_.t) && held_.size() == 0)
    state_.strain = held_.zero_state();
  return hand_pose().translation().norm() < largest_distance;
}

bool ForkBody::advance_freely(double h, const PathCheck& is_free) {
  held_.set_path_check(is_free);
  const bool advanced = advance(h, Wrench());
  held_.set_path_check({});
  return advanced;
}

void ForkBody::accept() {
  state_.energy_added += std::exchange(added_, 0.0);
  estimates_.add(std::exchange(trial_, {}));
  load_response_.begin_step(held_.size());
}

void ForkBody::restore(const bodies::TrialStart& start) {
  state_ = start.kept<State>();
  added_ = 0.0;
  trial_ = {};
  load_response_.begin_step(held_.size());
}

void ForkBody::archive(math::StateArchive& state) {
  state(held_, coupling_, control_, X_SH_, hand_, state_, estimates_, sleep_, load_W_);
  if (!state.is_restoring()) return;
  known_.reset();
  added_ = 0.0;
  trial_ = {};
  load_response_.begin_step(held_.size());
}

rod::TwistJacobian ForkBody::jacobian_W(const Matrix3d& R_WH, double t) const {
  rod::TwistJacobian J = held_.object_jacobian(t, state_.strain.q);
  for (int i = 0; i < J.cols(); ++i) {
    J.col(i).head<3>() = (R_WH * J.col(i).head<3>()).eval();
    J.col(i).tail<3>() = (R_WH * J.col(i).tail<3>()).eval();
  }
  return J;
}

rod::StrainMatrix ForkBody::inverse_mass() const {
  return held_.mass_matrix(state_.t, state_.strain.q)
      .llt()
      .solve(rod::StrainMatrix::Identity(held_.size(), held_.size()));
}

bodies::SteppedBody::Response ForkBody::response(double h) const {
  // A proxy has no mass, so an impulse does not change its motion.
  Response a{proxy_compliance(h), Matrix6d::Zero()};
  if (held_.size() > 0) {
    const auto J = jacobian_W();
    const dynamics::Integrator::Response r =
        load_response_.response(control_.integrator(), held_, handle(), h, state_.strain);
    a.displacement += J * r.q * J.transpose();
    a.by_impulse += J * r.q_dot * J.transpose();
  }
  return a;
}

void ForkBody::correct(double h, const Wrench& change_W) {
  motion::Proxy proxy = state_.proxy;
  if (!yields_everywhere()) {
    const RigidTransform offset = proxy_response(h, change_W) * proxy.offset();
    const Twist more = proxy.rate_to(offset, hand_pose().translation(), h);
    proxy.place(offset, to_twist(to_vector(proxy.rate()) + to_vector(more)));
  }
  if (held_.size() > 0) {
    const rod::StrainVector change = jacobian_W().transpose() * to_vector(change_W);
    const Eigen::Index known = load_response_.stops().cols();
    load_response_.correct(control_.integrator(), held_, handle(), h, change, state_.strain);
    trial_.stops += static_cast<int>(load_response_.stops().cols() - known);
  }
  state_.proxy = proxy;
}

Matrix6d ForkBody::strain_mobility() const {
  if (held_.size() == 0) return Matrix6d::Zero();
  const auto J = jacobian_W();
  return J * inverse_mass() * J.transpose();
}

Matrix6d ForkBody::mobility() const { return strain_mobility() + rigid_mobility(); }

void ForkBody::add_impulse(const Wrench& impulse_W) {
  sleep_ = Sleep();
  if (!yields_everywhere()) {
    state_.proxy.add_rate(to_twist(rigid_mobility() * to_vector(impulse_W)), object().X.translation());
  }
  if (held_.size() == 0) return;
  state_.strain.q_dot += inverse_mass() * (jacobian_W().transpose() * to_vector(impulse_W));
}

bool ForkBody::sleeps(double h, bool may_fall_asleep) {
  const motion::MotionState begin = hand_.at(state_.t), end = hand_.at(state_.t + h);
  const auto still = [](const motion::MotionState& s) {
    return s.velocity.linear.isZero(0.0) && s.velocity.angular.isZero(0.0);
  };
  const bool hand_rests = still(begin) && still(end) && begin.X.matrix() == end.X.matrix();
  const bool asleep = sleep_.version == held_.version() && sleep_.X_WH.matrix() == begin.X.matrix();
  if (hand_rests && asleep && may_fall_asleep) return true;
  sleep_ = Sleep();
  if (!hand_rests || !may_fall_asleep || state_.proxy.behind() || held_.returning()) return false;
  const motion::MotionState o = object_with_acceleration();
  const double L = held_.shape().length();
  const bool at_rest = std::max(o.velocity.linear.norm(), L * o.velocity.angular.norm()) < still_speed &&
                       (held_.size() == 0 ||
                        std::max(o.acceleration.linear.norm(), L * o.acceleration.angular.norm()) < still_acceleration);
  if (!at_rest) return false;
  state_.strain.q_dot.setZero();
  sleep_ = {held_.version(), begin.X};
  return true;
}

void ForkBody::take_twist(const Twist& V_WO_W) {
  state_.strain.q_dot = held_.project_twist(handle(), state_.strain.q, V_WO_W);
}

void ForkBody::block(double h) {
  added_ = 0.0;
  // The proxy handle and the strain stay constant, whatever the hand does next.
  state_.strain.q_dot.setZero();
  const RigidTransform before = hand_pose();
  state_.t += h;
  state_.proxy.rest(before, hand_.at(state_.t));
}

void ForkBody::follow_rigidly(double h) {
  added_ = 0.0;
  state_.strain.q_dot.setZero();
  state_.t += h;
}

}  // namespace spring_workbench::tools
