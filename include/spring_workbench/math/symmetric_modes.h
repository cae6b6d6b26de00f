#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::math {

/// Eigenvalues of a symmetric matrix of up to 6 × 6, in increasing order, and its eigenvectors as columns.
struct SymmetricModes {
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

  Vector values;
  Matrix vectors;
};

/// Solves A x = λ x with |x| = 1. Only the lower triangle of `A` is read.
SymmetricModes symmetric_modes(const SymmetricModes::Matrix& A);
/// Solves K x = λ M x with xᵀ M x = 1, for a positive definite `M`. Only the lower triangles are read.
SymmetricModes symmetric_modes(const SymmetricModes::Matrix& K, const SymmetricModes::Matrix& M);

}  // namespace spring_workbench::math
