#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench {

MotionSegment::Cubic MotionSegment::Cubic::hermite(const Vector3d& change, const Vector3d& slope_a,
                                                   const Vector3d& slope_b) {
  Cubic cubic;
  cubic.c[0] = slope_a;
  cubic.c[1] = 3.0 * change - 2.0 * slope_a - slope_b;
  cubic.c[2] = slope_a + slope_b - 2.0 * change;
  return cubic;
}

MotionSegment::MotionSegment(const RigidTransform& X, double begin, double end)
    : X_a_(X), begin_(begin), end_(end), moving_(false) {}

MotionSegment::MotionSegment(const PoseSample& a, const Vector3d& v_a, const Vector3d& w_a_B, const PoseSample& b,
                             const Vector3d& v_b, const Vector3d& w_b_B)
    : X_a_(a.X), begin_(a.t), end_(b.t), moving_(true) {
  const double h = b.t - a.t;
  position_ = Cubic::hermite(b.X.translation() - a.X.translation(), h * v_a, h * v_b);
  const Vector3d theta_b = log_so3(a.X.linear().transpose() * b.X.linear());
  rotation_ = Cubic::hermite(theta_b, h * w_a_B, h * (right_jacobian_inverse_so3(theta_b) * w_b_B));
}

double MotionSegment::begin() const { return begin_; }
double MotionSegment::end() const { return end_; }

MotionState MotionSegment::at(double t) const {
  MotionState state;
  state.X = X_a_;
  if (!moving_) return state;

  const double per_second = 1.0 / (end_ - begin_);
  const double u = (t - begin_) * per_second;
  state.X.translation() += position_.value(u);
  state.velocity.linear = position_.first(u) * per_second;
  state.acceleration.linear = position_.second(u) * per_second * per_second;

  const Vector3d theta = rotation_.value(u);
  const Vector3d theta_dot = rotation_.first(u) * per_second;
  const Vector3d theta_ddot = rotation_.second(u) * per_second * per_second;
  const Matrix3d J_r = right_jacobian_so3(theta);
  state.X.linear() = X_a_.linear() * exp_so3(theta);
  const Matrix3d R_WB = state.X.linear();
  state.velocity.angular = R_WB * (J_r * theta_dot);
  state.acceleration.angular = R_WB * (J_r * theta_ddot + right_jacobian_rate_so3(theta, theta_dot, theta_dot));
  return state;
}

}  // namespace spring_workbench
