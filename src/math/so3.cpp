#include "spring_workbench/math/so3.h"

#include <cmath>

namespace spring_workbench {
namespace {

/// e = (1/2 − b) / t and g = (1/6 − c) / t: from these two all coefficients follow without cancellation.
struct Tails {
  double e, g;
};

/// Their Taylor series up to the power `n` of t.
template <int n>
Tails taylor_tails(double t, double e = 1.0, double g = 1.0) {
  if constexpr (n == 0) {
    return {e * (1.0 / 24.0), g * (1.0 / 120.0)};
  } else {
    constexpr double next_e = 1.0 / ((2 * n + 3) * (2 * n + 4)), next_g = 1.0 / ((2 * n + 4) * (2 * n + 5));
    return taylor_tails<n - 1>(t, 1.0 - next_e * t * e, 1.0 - next_g * t * g);
  }
}

So3Coefficients from_tails(double t, const Tails& k) {
  So3Coefficients f;
  f.b = 0.5 - t * k.e;
  f.c = 1.0 / 6.0 - t * k.g;
  f.a = 1.0 - t * f.c;
  f.b_slope = k.e - 0.5 * f.c;
  f.c_slope = 1.5 * k.g - 0.5 * k.e;
  f.d = -f.b_slope / f.b;
  return f;
}

}  // namespace

So3Coefficients so3_coefficients(double t) {
  if (t < 1e-2) return from_tails(t, taylor_tails<4>(t));
  if (t < 1.0) return from_tails(t, taylor_tails<8>(t));
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

Matrix3d exp_so3(const Vector3d& theta) { return exp_so3(theta, so3_coefficients(theta.squaredNorm())); }

Matrix3d exp_so3(const Vector3d& theta, const So3Coefficients& k) {
  const double x = theta.x(), y = theta.y(), z = theta.z();
  const double bx = k.b * x, by = k.b * y, bz = k.b * z;
  const double ax = k.a * x, ay = k.a * y, az = k.a * z;
  Matrix3d R;
  R << 1.0 - by * y - bz * z, bx * y - az, bx * z + ay,  //
      bx * y + az, 1.0 - bx * x - bz * z, by * z - ax,   //
      bx * z - ay, by * z + ax, 1.0 - bx * x - by * y;
  return R;
}

Vector3d log_so3(const Matrix3d& R) {
  Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double n = q.vec().norm();
  if (n < 1e-12) return 2.0 * q.vec() / q.w();
  return 2.0 * std::atan2(n, q.w()) / n * q.vec();
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

}  // namespace spring_workbench
