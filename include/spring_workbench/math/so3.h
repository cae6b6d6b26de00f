#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench {

/// The functions of the angle θ in the exponential of SO(3), its Jacobians and their derivatives, from `t = θ²` ≥ 0, each
/// exact to rounding, also near zero.
struct So3Coefficients {
  double a;        ///< sin θ / θ
  double b;        ///< (1 − cos θ) / θ²
  double c;        ///< (θ − sin θ) / θ³
  double d;        ///< (1 − a / (2 b)) / θ²: the inverse Jacobian's; infinite at θ = 2π
  double b_slope;  ///< db/dt
  double c_slope;  ///< dc/dt
};
So3Coefficients so3_coefficients(double t);

/// The skew matrix `[v]×` with `[v]× w = v × w`.
Matrix3d skew(const Vector3d& v);

/// Rotation matrix of the rotation vector `theta` [rad]: `exp([theta]×)`. Exact to rounding for every length, also zero.
Matrix3d exp_so3(const Vector3d& theta);
/// The same where `k = so3_coefficients(theta.squaredNorm())` is known.
Matrix3d exp_so3(const Vector3d& theta, const So3Coefficients& k);

/// Rotation vector [rad] of length 0 … π with `exp_so3(log_so3(R)) = R`. At a half turn the axis' sign is free.
Vector3d log_so3(const Matrix3d& R);

/// Right Jacobian of SO(3): for `R = exp_so3(theta)`, the body rate is `J_r(theta) theta_dot`.
Matrix3d right_jacobian_so3(const Vector3d& theta);

/// Inverse of the right Jacobian; singular at |theta| = 2π.
Matrix3d right_jacobian_inverse_so3(const Vector3d& theta);

/// `d/dt [J_r(theta(t))] v` for the rate `theta_dot`: the part of the body's angular acceleration that is quadratic in the
/// rates when `v = theta_dot`.
Vector3d right_jacobian_rate_so3(const Vector3d& theta, const Vector3d& theta_dot, const Vector3d& v);

}  // namespace spring_workbench
