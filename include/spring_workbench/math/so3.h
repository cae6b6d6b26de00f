#pragma once

#include <cmath>

#include "spring_workbench/math/pack.h"
#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::math {

/// The functions of the angle θ in the exponential of SO(3), its Jacobians and their derivatives, from `t = θ²` ≥ 0,
/// each exact to rounding, also near zero.
template <typename S>
struct So3CoefficientsOf {
  S a;        ///< sin θ / θ
  S b;        ///< (1 − cos θ) / θ²
  S c;        ///< (θ − sin θ) / θ³
  S d;        ///< (1 − a / (2 b)) / θ²: the inverse Jacobian's; infinite at θ = 2π
  S b_slope;  ///< db/dt
  S c_slope;  ///< dc/dt
};
using So3Coefficients = So3CoefficientsOf<double>;

namespace so3_detail {

/// From `terms` terms of the Taylor series of e = (1/2 − b) / t and g = (1/6 − c) / t, from which all coefficients
/// follow without cancellation.
template <int terms, typename S>
SPRING_WORKBENCH_INLINE So3CoefficientsOf<S> from_series(const S& t) {
  S e = S{} + 1.0, g = e;
#pragma GCC unroll 8
  for (int n = terms; n > 0; --n) {
    e = 1.0 - (1.0 / ((2 * n + 3) * (2 * n + 4))) * t * e;
    g = 1.0 - (1.0 / ((2 * n + 4) * (2 * n + 5))) * t * g;
  }
  e = e * (1.0 / 24.0);
  g = g * (1.0 / 120.0);
  So3CoefficientsOf<S> f;
  f.b = 0.5 - t * e;
  f.c = 1.0 / 6.0 - t * g;
  f.a = 1.0 - t * f.c;
  f.b_slope = e - 0.5 * f.c;
  f.c_slope = 1.5 * g - 0.5 * e;
  f.d = -f.b_slope / f.b;
  return f;
}

}  // namespace so3_detail

/// The coefficients of a large angle.
So3Coefficients so3_coefficients_of_angle(double t);

template <typename S>
SPRING_WORKBENCH_INLINE So3CoefficientsOf<S> so3_coefficients(const S& t) {
  const double max_t = largest(t);
  if (max_t < 1e-2) return so3_detail::from_series<4>(t);
  if (max_t < 1.0) return so3_detail::from_series<8>(t);
  So3CoefficientsOf<S> f;
  for (int i = 0; i < lanes<S>; ++i) {
    const double t_i = lane(t, i);
    const So3Coefficients k = t_i < 1.0 ? so3_detail::from_series<8>(t_i) : so3_coefficients_of_angle(t_i);
    set_lane(f.a, i, k.a);
    set_lane(f.b, i, k.b);
    set_lane(f.c, i, k.c);
    set_lane(f.d, i, k.d);
    set_lane(f.b_slope, i, k.b_slope);
    set_lane(f.c_slope, i, k.c_slope);
  }
  return f;
}

/// `exp([theta]×)` where `k = so3_coefficients(|theta|²)` is known.
template <typename S>
SPRING_WORKBENCH_INLINE Mat3x3<S> exp_so3(const Vec3<S>& theta, const So3CoefficientsOf<S>& k) {
  return symmetric_and_skew(k.b, S(1.0 - k.b * dot(theta, theta)), k.a, theta);
}

/// The skew matrix `[v]×` with `[v]× w = v × w`.
Matrix3d skew(const Vector3d& v);

/// Rotation matrix of the rotation vector `theta` [rad]: `exp([theta]×)`. Exact to rounding for every length, also
/// zero.
Matrix3d exp_so3(const Vector3d& theta);

/// Rotation vector [rad] of length 0 … π with `exp_so3(log_so3(R)) = R`. At half a turn the sign of the axis is
/// arbitrary.
Vector3d log_so3(const Matrix3d& R);

/// Rotation vector [rad] from `X0` to `X1`, in the axes of `X0`.
inline Vector3d turn_between(const RigidTransform& X0, const RigidTransform& X1) {
  return log_so3(X0.linear().transpose() * X1.linear());
}

/// The pose at a `fraction` of the motion from `X0` to `X1` along a straight line and about one axis, both at constant
/// speed; `turn` is turn_between() of both.
RigidTransform between(const RigidTransform& X0, const RigidTransform& X1, const Vector3d& turn, double fraction);

/// Right Jacobian of SO(3): for `R = exp_so3(theta)`, the body rate is `J_r(theta) theta_dot`.
Matrix3d right_jacobian_so3(const Vector3d& theta);

/// Inverse of the right Jacobian; singular at |theta| = 2π.
Matrix3d right_jacobian_inverse_so3(const Vector3d& theta);

/// `d/dt [J_r(theta(t))] v` for the rate `theta_dot`: the part of the body's angular acceleration that is quadratic in
/// the rates when `v = theta_dot`.
Vector3d right_jacobian_rate_so3(const Vector3d& theta, const Vector3d& theta_dot, const Vector3d& v);

}  // namespace spring_workbench::math
