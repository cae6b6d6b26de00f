#pragma once

#include <Eigen/Core>

namespace spring_workbench::math {

/// The first column of `x`, repeated `columns` times.
template <int n, int columns, typename Matrix>
Eigen::Matrix<double, n, columns> side_by_side(const Matrix& x) {
  Eigen::Matrix<double, n, columns> all;
  for (int e = 0; e < n * columns; ++e) all(e) = x(e % n);
  return all;
}

}  // namespace spring_workbench::math
