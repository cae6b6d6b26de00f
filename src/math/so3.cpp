#include "spring_workbench/math/so3.h"

#include <cmath>

namespace spring_workbench {
namespace {

/// Coefficients of exp and of the Jacobians as functions of the angle, by Taylor series near zero.
struct Coefficients {
  double a;  ///< sin θ / θ
  double b;  ///< (1 − cos θ) / θ²
  double c;  ///< (θ − sin θ) / θ³
};

Coefficients coefficients(double theta_squared) {
  if (theta_squared < 1e-2) {
    const double t = theta_squared;
    return {1.0 - t / 6.0 * (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0 * (1.0 - t / 110.0)))),
            0.5 * (1.0 - t / 12.0 * (1.0 - t / 30.0 * (1.0 - t / 56.0 * (1.0 - t / 90.0 * (1.0 - t / 132.0))))),
            1.0 / 6.0 * (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0 * (1.0 - t / 110.0 * (1.0 - t / 156.0)))))};
  }
  const double theta = std::sqrt(theta_squared);
  const double s = std::sin(theta);
  const double half = std::sin(0.5 * theta);
  return {s / theta, 2.0 * half * half / theta_squared, (theta - s) / (theta * theta_squared)};
}

}  // namespace

Matrix3d skew(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Matrix3d exp_so3(const Vector3d& theta) {
  const Coefficients k = coefficients(theta.squaredNorm());
  const Matrix3d S = skew(theta);
  return Matrix3d::Identity() + k.a * S + k.b * S * S;
}

Vector3d log_so3(const Matrix3d& R) {
  Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double n = q.vec().norm();
  if (n < 1e-12) return 2.0 * q.vec() / q.w();
  return 2.0 * std::atan2(n, q.w()) / n * q.vec();
}

Matrix3d right_jacobian_so3(const Vector3d& theta) {
  const Coefficients k = coefficients(theta.squaredNorm());
  const Matrix3d S = skew(theta);
  return Matrix3d::Identity() - k.b * S + k.c * S * S;
}

Matrix3d right_jacobian_inverse_so3(const Vector3d& theta) {
  const double t = theta.squaredNorm();
  const Coefficients k = coefficients(t);
  const Matrix3d S = skew(theta);
  // (1/θ²) (1 − a / (2 b)), which near zero is 1/12 + θ²/720 + θ⁴/30240 + …
  const double d = t < 1e-2 ? (1.0 / 12.0) * (1.0 + t / 60.0 * (1.0 + t / 42.0 * (1.0 + t / 40.0)))
                            : (1.0 - 0.5 * k.a / k.b) / t;
  return Matrix3d::Identity() + 0.5 * S + d * S * S;
}

Vector3d right_jacobian_rate_so3(const Vector3d& theta, const Vector3d& theta_dot, const Vector3d& v) {
  const double t = theta.squaredNorm();
  const Coefficients k = coefficients(t);
  // Derivatives of b and c with respect to θ²: b' = (a − 2b)/(2θ²), c' = (b − 3c)/(2θ²).
  double b_prime, c_prime;
  if (t < 1e-2) {
    b_prime = -1.0 / 24.0 * (1.0 - t / 15.0 * (1.0 - t * 3.0 / 112.0 * (1.0 - t * 2.0 / 135.0)));
    c_prime = -1.0 / 120.0 * (1.0 - t / 21.0 * (1.0 - t / 48.0 * (1.0 - t * 2.0 / 165.0)));
  } else {
    b_prime = (k.a - 2.0 * k.b) / (2.0 * t);
    c_prime = (k.b - 3.0 * k.c) / (2.0 * t);
  }
  const double t_dot = 2.0 * theta.dot(theta_dot);
  const Vector3d S_v = theta.cross(v);
  const Vector3d S_dot_v = theta_dot.cross(v);
  return -b_prime * t_dot * S_v - k.b * S_dot_v + c_prime * t_dot * theta.cross(S_v) +
         k.c * (theta_dot.cross(S_v) + theta.cross(S_dot_v));
}

}  // namespace spring_workbench
