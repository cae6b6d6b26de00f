#include "separation.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "constants.h"
#include "triangular_separation.h"

namespace spring_workbench::exponential {
namespace {

using Matrix = Separation::Matrix;

Separation none(Eigen::Index size) {
  const Matrix nan = Matrix::Constant(size, size, std::numeric_limits<double>::quiet_NaN());
  return {nan, nan, nan, {}};
}

Separation of_coupled(const Matrix& A) {
  if (A.rows() <= 2) return {Matrix::Identity(A.rows(), A.rows()), Matrix::Identity(A.rows(), A.rows()), A, {}};
  Eigen::RealSchur<Matrix> schur(A.rows());
  schur.setMaxIterations(most_iterations * A.rows());
  if (schur.compute(A).info() != Eigen::Success) return none(A.rows());
  const TriangularSeparation of_T(schur.matrixT());
  return {schur.matrixU() * of_T.Y, of_T.Y.triangularView<Eigen::UnitUpper>().solve(schur.matrixU().transpose()),
          of_T.B, of_T.cluster};
}

using Rows = Eigen::Matrix<int, Eigen::Dynamic, 1, 0, ModalRates::max_modes, 1>;

/// For each row, the first of all that it is coupled with, directly or through others.
Rows first_coupled(const Matrix& A) {
  const auto size = static_cast<int>(A.rows());
  Rows first = Rows::LinSpaced(size, 0, size - 1);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      if (A(i, j) == 0.0) continue;
      const int a = std::min(first[i], first[j]), b = std::max(first[i], first[j]);
      first = (first.array() == b).select(a, first);
    }
  }
  return first;
}

}  // namespace

Separation separated(const Matrix& A) {
  if (!A.allFinite()) return none(A.rows());
  const Matrix zero = Matrix::Zero(A.rows(), A.rows());
  Separation all{zero, zero, zero, {}};
  const Rows first = first_coupled(A);
  int done = 0;
  for (int i = 0; i < A.rows(); ++i) {
    Rows rows(A.rows());
    int size = 0;
    for (int row = 0; row < A.rows(); ++row) {
      if (first[row] == i) rows[size++] = row;
    }
    Matrix own(size, size);
    for (int a = 0; a < size; ++a) {
      for (int b = 0; b < size; ++b) own(a, b) = A(rows[a], rows[b]);
    }
    const Separation part = of_coupled(own);
    all.blocks.block(done, done, size, size) = part.blocks;
    for (int a = 0; a < size; ++a) {
      const int place = done + a;
      all.cluster[static_cast<std::size_t>(place)] = done + part.cluster[static_cast<std::size_t>(a)];
      for (int b = 0; b < size; ++b) {
        all.columns(rows[a], done + b) = part.columns(a, b);
        all.inverse(place, rows[b]) = part.inverse(a, b);
      }
    }
    done += size;
  }
  return all;
}

}  // namespace spring_workbench::exponential
