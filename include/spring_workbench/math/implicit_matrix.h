#pragma once

#include <Eigen/LU>

namespace spring_workbench::math {

/// Solves `(M + d D + d² K) x = b`, the equation of an implicit step, for up to six coordinates; scaled to unit
/// diagonal, so that light and heavy ones can be combined.
class ImplicitMatrix {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

  ImplicitMatrix(const Matrix& M, const Matrix& D, const Matrix& K, double d) {
    const Matrix A = M + d * D + d * d * K;
    scale_ = A.diagonal().cwiseAbs().cwiseMax(M.diagonal()).cwiseSqrt().cwiseInverse();
    lu_.compute(scale_.asDiagonal() * A * scale_.asDiagonal());
  }
  Matrix solve(const Matrix& b) const { return scale_.asDiagonal() * lu_.solve(Matrix(scale_.asDiagonal() * b)); }
  template <int n>
  Eigen::Matrix<double, n, 1> solve(const Eigen::Matrix<double, n, 1>& b) const {
    const Eigen::Map<const Eigen::Matrix<double, n, n>> LU(lu_.matrixLU().data());
    Eigen::Matrix<double, n, 1> x;
    for (int i = 0; i < n; ++i) x[lu_.permutationP().indices()[i]] = scale_[i] * b[i];
    LU.template triangularView<Eigen::UnitLower>().solveInPlace(x);
    LU.template triangularView<Eigen::Upper>().solveInPlace(x);
    for (int i = 0; i < n; ++i) x[i] *= scale_[i];
    return x;
  }

 private:
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> scale_;
  Eigen::PartialPivLU<Matrix> lu_;
};

}  // namespace spring_workbench::math
