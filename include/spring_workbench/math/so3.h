#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench {

/// The skew matrix `[v]×` with `[v]× w = v × w`.
Matrix3d skew(const Vector3d& v);

/// Rotation matrix of the rotation vector `theta` [rad]: `exp([theta]×)`. Exact to rounding for every length, also zero.
Matrix3d exp_so3(const Vector3d& theta);

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
