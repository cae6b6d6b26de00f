#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench {
namespace {

/// Whether a rotation from `a` to `b` with these rates at its ends is none.
bool no_turn(const PoseSample& a, const Vector3d& w_a, const PoseSample& b, const Vector3d& w_b) {
  return w_a.isZero(0.0) && w_b.isZero(0.0) && a.X.linear() == b.X.linear();
}

}  // namespace

MotionSegment::Polynomial MotionSegment::Polynomial::cubic(const Vector3d& change, const Vector3d& slope_a,
                                                           const Vector3d& slope_b) {
  return {{slope_a, 3.0 * change - 2.0 * slope_a - slope_b, slope_a + slope_b - 2.0 * change, Vector3d::Zero(),
           Vector3d::Zero()}};
}

MotionSegment::Polynomial MotionSegment::Polynomial::quintic(const Vector3d& change, const Vector3d& slope_a,
                                                             const Vector3d& slope_b, const Vector3d& curve_a,
                                                             const Vector3d& curve_b) {
  // What is left of change, slope and second derivative at the end after the terms of the start.
  const Vector3d x = change - slope_a - 0.5 * curve_a;
  const Vector3d v = slope_b - slope_a - curve_a;
  const Vector3d a = curve_b - curve_a;
  return {{slope_a, 0.5 * curve_a, 10.0 * x - 4.0 * v + 0.5 * a, 7.0 * v - 15.0 * x - a, 6.0 * x - 3.0 * v + 0.5 * a}};
}

MotionSegment::MotionSegment(const RigidTransform& X, double begin, double end)
    : X_a_(X), begin_(begin), end_(end), moving_(false) {}

MotionSegment::MotionSegment(const PoseSample& a, const Vector3d& v_a, const Vector3d& w_a_B, const PoseSample& b,
                             const Vector3d& v_b, const Vector3d& w_b_B)
    : X_a_(a.X), begin_(a.t), end_(b.t), moving_(true), turning_(!no_turn(a, w_a_B, b, w_b_B)) {
  const double h = b.t - a.t;
  position_ = Polynomial::cubic(b.X.translation() - a.X.translation(), h * v_a, h * v_b);
  if (!turning_) return;
  const Vector3d theta_b = log_so3(a.X.linear().transpose() * b.X.linear());
  rotation_ = Polynomial::cubic(theta_b, h * w_a_B, h * (right_jacobian_inverse_so3(theta_b) * w_b_B));
}

MotionSegment::MotionSegment(const MotionSample& a, const MotionSample& b)
    : X_a_(a.pose.X),
      begin_(a.pose.t),
      end_(b.pose.t),
      moving_(true),
      turning_(!(no_turn(a.pose, a.w_B, b.pose, b.w_B) && a.alpha_B.isZero(0.0) && b.alpha_B.isZero(0.0))) {
  const double h = b.pose.t - a.pose.t;
  position_ = Polynomial::quintic(b.pose.X.translation() - a.pose.X.translation(), h * a.v_W, h * b.v_W,
                                  h * h * a.a_W, h * h * b.a_W);
  if (!turning_) return;
  const Vector3d theta_b = log_so3(a.pose.X.linear().transpose() * b.pose.X.linear());
  const Matrix3d inverse = right_jacobian_inverse_so3(theta_b);
  const Vector3d slope_b = h * (inverse * b.w_B);
  // alpha = J_r θ̈ + J̇_r θ̇; at θ = 0 the second term is −½ θ̇ × θ̇ = 0.
  const Vector3d curve_b = inverse * (h * h * b.alpha_B - right_jacobian_rate_so3(theta_b, slope_b, slope_b));
  rotation_ = Polynomial::quintic(theta_b, h * a.w_B, slope_b, h * h * a.alpha_B, curve_b);
}

double MotionSegment::begin() const { return begin_; }
double MotionSegment::end() const { return end_; }

OwnAxesMotion MotionSegment::in_own_axes(double t) const {
  OwnAxesMotion m;
  m.X = X_a_;
  if (!moving_) return m;

  const double per_second = 1.0 / (end_ - begin_);
  const double u = (t - begin_) * per_second;
  m.X.translation() += position_.value(u);
  m.v_W = position_.first(u) * per_second;
  m.a_W = position_.second(u) * (per_second * per_second);
  if (!turning_) return m;

  const Vector3d theta = rotation_.value(u);
  const Vector3d theta_dot = rotation_.first(u) * per_second;
  const Vector3d theta_ddot = rotation_.second(u) * (per_second * per_second);
  const So3Coefficients k = so3_coefficients(theta.squaredNorm());
  m.X.linear().noalias() = X_a_.linear() * exp_so3(theta, k);
  // J_r v = v − b θ×v + c θ×(θ×v), and its derivative along the motion with v = θ̇.
  const Vector3d s = theta.cross(theta_dot);
  const Vector3d s_s = theta.cross(s);
  const Vector3d a = theta.cross(theta_ddot);
  const double t_dot = 2.0 * theta.dot(theta_dot);
  m.w_B = theta_dot - k.b * s + k.c * s_s;
  m.alpha_B = theta_ddot - k.b * a + k.c * theta.cross(a) - k.b_slope * t_dot * s + k.c_slope * t_dot * s_s +
              k.c * theta_dot.cross(s);
  return m;
}

MotionState MotionSegment::at(double t) const {
  const OwnAxesMotion m = in_own_axes(t);
  MotionState state;
  state.X = m.X;
  state.velocity.linear = m.v_W;
  state.velocity.angular = m.X.linear() * m.w_B;
  state.acceleration.linear = m.a_W;
  state.acceleration.angular = m.X.linear() * m.alpha_B;
  return state;
}

}  // namespace spring_workbench
