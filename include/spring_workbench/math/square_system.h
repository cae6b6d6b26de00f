#pragma once

#include <cmath>

#include "spring_workbench/math/pack.h"

namespace spring_workbench::math {

/// QR decomposition of a small nonsingular matrix (modified Gram–Schmidt, column by column), which solves systems with
/// it and with its transpose. One matrix (`S` double) or, with packs, several.
template <int n, typename S>
class SquareSystem {
 public:
  SquareSystem() = default;  ///< without a matrix
  /// `columns[j]`: column j.
  explicit SquareSystem(const S (&columns)[n][n]) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) Q_[j][i] = columns[j][i];
      for (int k = 0; k < j; ++k) {
        R_[k][j] = product(Q_[k], Q_[j]);
        for (int i = 0; i < n; ++i) Q_[j][i] -= R_[k][j] * Q_[k][i];
      }
      const S squared = product(Q_[j], Q_[j]);
      for (int l = 0; l < lanes<S>; ++l) set_lane(R_[j][j], l, std::sqrt(lane(squared, l)));
      inverse_[j] = 1.0 / R_[j][j];
      for (int i = 0; i < n; ++i) Q_[j][i] = inverse_[j] * Q_[j][i];
    }
  }

  /// Solves A x = b.
  SPRING_WORKBENCH_INLINE void solve(const S (&b)[n], S (&x)[n]) const {
    for (int j = n - 1; j >= 0; --j) {
      x[j] = product(Q_[j], b);
      for (int k = j + 1; k < n; ++k) x[j] -= R_[j][k] * x[k];
      x[j] = inverse_[j] * x[j];
    }
  }
  /// Solves Aᵀ x = b.
  SPRING_WORKBENCH_INLINE void solve_transposed(const S (&b)[n], S (&x)[n]) const {
    S y[n];
    for (int j = 0; j < n; ++j) {
      y[j] = b[j];
      for (int k = 0; k < j; ++k) y[j] -= R_[k][j] * y[k];
      y[j] = inverse_[j] * y[j];
    }
    for (int i = 0; i < n; ++i) {
      x[i] = Q_[0][i] * y[0];
      for (int j = 1; j < n; ++j) x[i] += Q_[j][i] * y[j];
    }
  }
  /// Σ (D A⁻¹)², over all elements, for a diagonal D.
  SPRING_WORKBENCH_INLINE S inverse_norm_squared(const double (&D)[n]) const {
    S sum{};
    for (int j = 0; j < n; ++j) {
      S x[n];
      for (int i = j; i >= 0; --i) {
        x[i] = S{} + (i == j ? 1.0 : 0.0);
        for (int k = i + 1; k <= j; ++k) x[i] -= R_[i][k] * x[k];
        x[i] = inverse_[i] * x[i];
        sum += (D[i] * D[i]) * (x[i] * x[i]);
      }
    }
    return sum;
  }

 private:
  SPRING_WORKBENCH_INLINE static S product(const S (&a)[n], const S (&b)[n]) {
    S sum = a[0] * b[0];
    for (int i = 1; i < n; ++i) sum += a[i] * b[i];
    return sum;
  }
  S Q_[n][n], R_[n][n], inverse_[n];
};

}  // namespace spring_workbench::math
