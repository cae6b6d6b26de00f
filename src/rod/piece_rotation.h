#pragma once

#include <array>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench {

/// The rotation along a piece of a rod whose strain is a polynomial of `degree`, as a power series of its quaternion about
/// the middle. The series of q' = ½ q (a₀ + a₁ u + …) converges for every strain; pieces that turn by less than 2.5 rad
/// leave 1e-13.
template <int degree>
class PieceRotation {
 public:
  /// The strain over the piece of length h is (a[0] + a[1] u + …) / h for u = −½ … ½.
  explicit PieceRotation(const std::array<Vector3d, degree + 1>& a) {
    double angle = 0.0, power = 1.0;
    for (const Vector3d& term : a) {
      angle += power * term.norm();
      power *= 0.5;
    }
    terms_ = angle < 0.5 ? 13 : angle < 1.2 ? 16 : most_terms;
    coefficients_[0] << 0.0, 0.0, 0.0, 1.0;
    coefficients_[1] = 0.5 * times(coefficients_[0], a[0]);
    for (int n = 1; n + 1 < terms_; ++n) {
      Coefficients sum = times(coefficients_[n], a[0]);
      for (int d = 1; d <= degree && d <= n; ++d) sum += times(coefficients_[n - d], a[static_cast<std::size_t>(d)]);
      coefficients_[n + 1] = 0.5 / (n + 1) * sum;
    }
    from_start_ = at_middle(-0.5).conjugate();
  }

  /// Rotation from the piece's start to `u`.
  Quaterniond at(double u) const { return from_start_ * at_middle(u); }

 private:
  static constexpr int most_terms = 21;
  using Coefficients = Eigen::Vector4d;  // x, y, z, w

  static Coefficients times(const Coefficients& q, const Vector3d& v) {
    Coefficients r;
    r.head<3>() = q[3] * v + q.head<3>().cross(v);
    r[3] = -q.head<3>().dot(v);
    return r;
  }
  Quaterniond at_middle(double u) const {
    Coefficients sum = coefficients_[terms_ - 1];
    for (int n = terms_ - 2; n >= 0; --n) sum = coefficients_[n] + u * sum;
    return Quaterniond(sum);
  }

  int terms_;
  Coefficients coefficients_[most_terms];
  Quaterniond from_start_;
};

}  // namespace spring_workbench
