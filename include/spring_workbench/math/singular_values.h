#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::math {

/// Singular value decomposition of a 6 × 6 matrix, A = U diag(values) Vᵀ.
struct SingularValues {
  Matrix6d U, V;    ///< orthogonal
  Vector6d values;  ///< ≥ 0, the largest first
};

SingularValues singular_values(const Matrix6d& A);

/// Returns the shortest `x` that minimises |A x − b|. Singular values that are zero to rounding count as zero.
Vector6d least_squares(const Matrix6d& A, const Vector6d& b);

}  // namespace spring_workbench::math
