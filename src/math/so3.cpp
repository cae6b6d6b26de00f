#include "spring_workbench/math/so3.h"

#include <cmath>

namespace spring_workbench::math {

So3Coefficients so3_coefficients_of_angle(double t) {
  const double theta = std::sqrt(t);
  const double s = std::sin(theta);
  const double half = std::sin(0.5 * theta);
  So3Coefficients f;
  f.a = s / theta;
  f.b = 2.0 * half * half / t;
  f.c = (theta - s) / (theta * t);
  f.d = (1.0 - 0.5 * f.a / f.b) / t;
  f.b_slope = (f.a - 2.0 * f.b) / (2.0 * t);
  f.c_slope = (f.b - 3.0 * f.c) / (2.0 * t);
  return f;
}

Matrix3d skew(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Matrix3d exp_so3(const Vector3d& theta) {
  return matrix(exp_so3(vec3(theta), so3_coefficients(theta.squaredNorm())), 0);
}

Vector3d log_so3(const Matrix3d& R) {
  Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double n = q.vec().norm();
  if (n < 1e-12) return 2.0 * q.vec() / q.w();
  return 2.0 * std::atan2(n, q.w()) / n * q.vec();
}

RigidTransform between(const RigidTransform& X0, const RigidTransform& X1, const Vector3d& turn, double fraction) {
  RigidTransform X = X0;
  X.linear() = X0.linear() * exp_so3(fraction * turn);
  X.translation() += fraction * (X1.translation() - X0.translation());
  return X;
}

Matrix3d right_jacobian_so3(const Vector3d& theta) {
  const So3Coefficients k = so3_coefficients(theta.squaredNorm());
  const Matrix3d S = skew(theta);
  return Matrix3d::Identity() - k.b * S + k.c * S * S;
}

Matrix3d right_jacobian_inverse_so3(const Vector3d& theta) {
  const So3Coefficients k = so3_coefficients(theta.squaredNorm());
  const Matrix3d S = skew(theta);
  return Matrix3d::Identity() + 0.5 * S + k.d * S * S;
}

Vector3d right_jacobian_rate_so3(const Vector3d& theta, const Vector3d& theta_dot, const Vector3d& v) {
  const So3Coefficients k = so3_coefficients(theta.squaredNorm());
  const double t_dot = 2.0 * theta.dot(theta_dot);
  const Vector3d S_v = theta.cross(v);
  const Vector3d S_dot_v = theta_dot.cross(v);
  return -k.b_slope * t_dot * S_v - k.b * S_dot_v + k.c_slope * t_dot * theta.cross(S_v) +
         k.c * (theta_dot.cross(S_v) + theta.cross(S_dot_v));
}

}  // namespace spring_workbench::math
