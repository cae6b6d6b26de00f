#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::motion {
namespace {

/// Whether the orientation is constant: the same at `a` and `b`, with zero rates at both ends.
bool no_turn(const PoseSample& a, const Vector3d& w_a, const PoseSample& b, const Vector3d& w_b) {
  return w_a.isZero(0.0) && w_b.isZero(0.0) && a.X.linear() == b.X.linear();
}

}  // namespace

MotionSegment::Polynomial MotionSegment::Polynomial::cubic(const Vector3d& change, const Vector3d& slope_a,
                                                           const Vector3d& slope_b) {
  return {{slope_a, 3.0 * change - 2.0 * slope_a - slope_b, slope_a + slope_b - 2.0 * change}};
}

MotionSegment::MotionSegment(const RigidTransform& X, double begin, double end)
    : X_a_(X), begin_(begin), end_(end), moving_(false) {}

MotionSegment::MotionSegment(const PoseSample& a, const Vector3d& v_a, const Vector3d& w_a_B, const PoseSample& b,
                             const Vector3d& v_b, const Vector3d& w_b_B)
    : X_a_(a.X), begin_(a.t), end_(b.t), moving_(true), turning_(!no_turn(a, w_a_B, b, w_b_B)) {
  const double h = b.t - a.t;
  position_ = Polynomial::cubic(b.X.translation() - a.X.translation(), h * v_a, h * v_b);
  if (!turning_) return;
  const Vector3d theta_b = math::turn_between(a.X, b.X);
  rotation_ = Polynomial::cubic(theta_b, h * w_a_B, h * (math::right_jacobian_inverse_so3(theta_b) * w_b_B));
}

template <typename S>
SPRING_WORKBENCH_INLINE MotionSegment::Turn<S> MotionSegment::turn(const S& u, double per_second) const {
  const math::Vec3<S> theta = rotation_.value(u);
  const math::Vec3<S> theta_dot = per_second * rotation_.first(u);
  const math::Vec3<S> theta_ddot = (per_second * per_second) * rotation_.second(u);
  const math::So3CoefficientsOf<S> k = math::so3_coefficients(dot(theta, theta));
  // J_r v = v − b θ×v + c θ×(θ×v), and its derivative along the motion with v = θ̇.
  const math::Vec3<S> s = math::cross(theta, theta_dot), s_s = math::cross(theta, s),
                      a = math::cross(theta, theta_ddot);
  const S t_dot = 2.0 * dot(theta, theta_dot);
  const S b_dot = k.b_slope * t_dot, c_dot = k.c_slope * t_dot;
  return {math::exp_so3(theta, k), theta_dot - k.b * s + k.c * s_s,
          theta_ddot - k.b * a + k.c * (math::cross(theta, a) + math::cross(theta_dot, s)) - b_dot * s + c_dot * s_s};
}

MotionSegment MotionSegment::of_frame(const RigidTransform& X_BC) const {
  MotionSegment moved = *this;
  moved.X_BC_ = X_BC_ * X_BC;
  moved.has_offset_ = true;
  return moved;
}

BodyFrameRates<math::Pack> MotionSegment::at_frame(const BodyFrameRates<math::Pack>& f) const {
  const math::Mat3x3<double> R = math::mat3x3(X_BC_.linear());
  const math::Vec3<double> p = math::vec3(X_BC_.translation());
  const math::Vec3<math::Pack> a = f.a_B + math::cross(f.alpha_B, p) + math::cross(f.w_B, math::cross(f.w_B, p));
  return {f.R_WB * R, math::transposed(R, f.v_B + math::cross(f.w_B, p)), math::transposed(R, f.w_B),
          math::transposed(R, f.alpha_B), math::transposed(R, a)};
}

BodyRateState MotionSegment::body_rate_state(double t) const {
  const BodyRateState of_B = of_samples(t);
  if (!has_offset_) return of_B;
  const Matrix3d& R_WB = of_B.X.linear();
  const Vector3d& p = X_BC_.translation();
  const Vector3d& w = of_B.w_B;
  BodyRateState m;
  m.X = of_B.X * X_BC_;
  m.v_W = of_B.v_W + R_WB * w.cross(p);
  m.a_W = of_B.a_W + R_WB * (of_B.alpha_B.cross(p) + w.cross(w.cross(p)));
  m.w_B = X_BC_.linear().transpose() * w;
  m.alpha_B = X_BC_.linear().transpose() * of_B.alpha_B;
  return m;
}

BodyFrameRates<math::Pack> MotionSegment::body_frame_rates(const math::Pack& t, double gravity) const {
  const BodyFrameRates<math::Pack> of_B = of_samples(t, gravity);
  return has_offset_ ? at_frame(of_B) : of_B;
}

BodyRateState MotionSegment::of_samples(double t) const {
  BodyRateState m;
  m.X = X_a_;
  if (!moving_) return m;

  const double per_second = 1.0 / (end_ - begin_);
  const double u = (t - begin_) * per_second;
  m.X.translation() += math::vector(position_.value(u));
  m.v_W = math::vector(per_second * position_.first(u));
  m.a_W = math::vector((per_second * per_second) * position_.second(u));
  if (!turning_) return m;
  const Turn<double> by = turn(u, per_second);
  m.X.linear().noalias() = X_a_.linear() * matrix(by.R, 0);
  m.w_B = math::vector(by.w_B);
  m.alpha_B = math::vector(by.alpha_B);
  return m;
}

SPRING_WORKBENCH_WIDE BodyFrameRates<math::Pack> MotionSegment::of_samples(const math::Pack& t, double gravity) const {
  const math::Mat3x3<double> R_a = math::mat3x3(X_a_.linear());
  const math::Vec3<double> up = gravity * math::Vec3<double>{R_a.x.z, R_a.y.z, R_a.z.z};
  const math::Vec3<math::Pack> zero = math::zero<math::Pack>();
  BodyFrameRates<math::Pack> f{{zero + R_a.x, zero + R_a.y, zero + R_a.z}, zero, zero, zero, zero + up};
  if (!moving_) return f;
  const double per_second = 1.0 / (end_ - begin_);
  const math::Pack u = (t - begin_) * per_second;
  f.v_B = math::transposed(R_a, per_second * position_.first(u));
  f.a_B += math::transposed(R_a, (per_second * per_second) * position_.second(u));
  if (!turning_) return f;
  const Turn<math::Pack> by = turn(u, per_second);
  f.R_WB = R_a * by.R;
  f.w_B = by.w_B;
  f.alpha_B = by.alpha_B;
  f.v_B = math::transposed(by.R, f.v_B);
  f.a_B = math::transposed(by.R, f.a_B);
  return f;
}

MotionState MotionSegment::at(double t) const {
  const BodyRateState m = body_rate_state(t);
  MotionState state;
  state.X = m.X;
  state.velocity.linear = m.v_W;
  state.velocity.angular = m.X.linear() * m.w_B;
  state.acceleration.linear = m.a_W;
  state.acceleration.angular = m.X.linear() * m.alpha_B;
  return state;
}

}  // namespace spring_workbench::motion
