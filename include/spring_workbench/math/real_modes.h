#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <complex>
#include <limits>

namespace spring_workbench::math {

/// The eigenvectors of a real matrix A in real columns: A vectors = vectors B. The first 2 `pairs` columns are the real
/// and the imaginary part of an eigenvector for each conjugate pair of rates a ± i b, b > 0, where B has the block
/// ((a, b), (−b, a)); the others belong to real rates.
template <typename Matrix>
struct RealModes {
  Matrix vectors, inverse;
  int pairs = 0;
  Eigen::Matrix<std::complex<double>, Matrix::RowsAtCompileTime, 1, 0, Matrix::MaxRowsAtCompileTime, 1>
      rates;  ///< a pair has its rate with b > 0 twice
  /// Of the vectors. Infinity: A has no such vectors, or none were found; NaN, as the vectors: A is not finite.
  double condition = std::numeric_limits<double>::quiet_NaN();

  RealModes() = default;
  explicit RealModes(const Matrix& A) : vectors(A), inverse(A), rates(A.rows()) {
    const Eigen::EigenSolver<Matrix> solver(A);
    vectors.setConstant(std::numeric_limits<double>::quiet_NaN());
    inverse = vectors;
    if (solver.info() != Eigen::Success) return;
    const auto& values = solver.eigenvalues();
    const auto of_values = solver.eigenvectors().eval();
    Matrix B = Matrix::Zero(A.rows(), A.rows());
    Eigen::Index at = 0;
    const auto add = [&](const auto& column, std::complex<double> rate) {
      rates[at] = rate;
      B(at, at) = rate.real();
      vectors.col(at++) = column;
    };
    for (Eigen::Index m = 0; m < values.size(); ++m) {
      if (!(values[m].imag() > 0.0)) continue;
      add(of_values.col(m).real(), values[m]);
      add(of_values.col(m).imag(), values[m]);
      B(at - 2, at - 1) = values[m].imag();
      B(at - 1, at - 2) = -values[m].imag();
      ++pairs;
    }
    for (Eigen::Index m = 0; m < values.size(); ++m) {
      if (values[m].imag() == 0.0) add(of_values.col(m).real(), values[m]);
    }
    inverse = vectors.partialPivLu().inverse();
    // Of two rates that are equal to the last bit, EigenSolver may take for eigenvectors what is none.
    const bool found = inverse.allFinite() && (A * vectors - vectors * B).norm() < rounding * A.norm() * vectors.norm();
    condition = found ? vectors.norm() * inverse.norm() : std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr double rounding = 1e-12;  ///< more than it leaves of A vectors − vectors B
};

}  // namespace spring_workbench::math
