#pragma once

#include <Eigen/Core>

namespace spring_workbench {

/// `x` with `M x = b` for a small symmetric positive definite `M`, of which the lower triangle is read: L D Lᵀ without roots
/// or pivots, several times faster at these sizes than Eigen's own, whose loops are made for large matrices.
template <int n>
Eigen::Matrix<double, n, 1> solve_positive_definite(Eigen::Matrix<double, n, n> M, Eigen::Matrix<double, n, 1> b) {
  double inverse[n];
  for (int j = 0; j < n; ++j) {
    inverse[j] = 1.0 / M(j, j);
    for (int i = j + 1; i < n; ++i) {
      const double l = M(i, j) * inverse[j];
      for (int k = i; k < n; ++k) M(k, i) -= M(k, j) * l;
      b[i] -= l * b[j];
    }
  }
  for (int j = n - 1; j >= 0; --j) {
    for (int i = j + 1; i < n; ++i) b[j] -= M(i, j) * b[i];
    b[j] *= inverse[j];
  }
  return b;
}

}  // namespace spring_workbench
