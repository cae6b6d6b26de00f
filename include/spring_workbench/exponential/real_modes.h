#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <limits>

#include "spring_workbench/exponential/general_complex.h"
#include "spring_workbench/exponential/oscillator_modes.h"

namespace spring_workbench::exponential {

/// The modes of a real matrix A in real columns: A vectors = vectors B. The first 2 `pairs` columns form pairs: a pair
/// of rate a + b j, j² = square, has the block ((a, b), (square b, a)) in B. Two conjugate rates form a pair, with the
/// real and the imaginary part of an eigenvector as columns; so do the two rates of an oscillator that is coupled with
/// no other coordinate (OscillatorModes), even if they coincide. The other columns belong to single real rates.
template <typename Matrix>
struct RealModes {
  Matrix vectors, inverse;
  int pairs = 0;
  Eigen::Matrix<GeneralComplex, Matrix::RowsAtCompileTime, 1, 0, Matrix::MaxRowsAtCompileTime, 1>
      rates;  ///< the rate of a pair is listed twice
  /// Condition number of the vectors. Infinity: A has no such vectors, or none were found. NaN: A is not finite; nor
  /// are the vectors.
  double condition = std::numeric_limits<double>::quiet_NaN();

  RealModes() = default;
  explicit RealModes(const Matrix& A) : vectors(A), inverse(A), rates(A.rows()) {
    vectors.setConstant(std::numeric_limits<double>::quiet_NaN());
    inverse = vectors;
    if (!A.allFinite() || !find(A)) return;
    inverse = vectors.partialPivLu().inverse();
    // If two rates are bit-identical, EigenSolver may return vectors that are no eigenvectors.
    const bool found =
        inverse.allFinite() && (A * vectors - vectors * blocks()).norm() < rounding * A.norm() * vectors.norm();
    condition = found ? vectors.norm() * inverse.norm() : std::numeric_limits<double>::infinity();
  }

  Matrix blocks() const {  ///< B
    Matrix B = Matrix::Zero(vectors.rows(), vectors.rows());
    for (Eigen::Index i = 0; i < B.rows(); ++i) B(i, i) = rates[i].re;
    for (int i = 0; i < 2 * pairs; i += 2) {
      B(i, i + 1) = rates[i].im;
      B(i + 1, i) = rates[i].square * rates[i].im;
    }
    return B;
  }

 private:
  static constexpr double rounding = 1e-12;  ///< relative; larger than the rounding errors of A vectors − vectors B
  static constexpr int max_size = Matrix::MaxRowsAtCompileTime;
  using Rows = Eigen::Matrix<Eigen::Index, Eigen::Dynamic, 1, 0, max_size, 1>;
  using Part = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_size, max_size>;

  /// Sets vectors and rates. Returns false if there are none.
  bool find(const Matrix& A) {
    const Rows mate = mates(A), coupled = rows_without(mate);
    Eigen::EigenSolver<Part> solver(coupled.size());
    if (coupled.size() > 0 && solver.compute(part(A, coupled)).info() != Eigen::Success) return false;
    vectors.setZero();
    Eigen::Index at = 0;
    const auto add = [&](const Rows& rows, const auto& column, const GeneralComplex& rate) {
      for (Eigen::Index i = 0; i < rows.size(); ++i) vectors(rows[i], at) = column[i];
      rates[at++] = rate;
    };
    for (const bool paired : {true, false}) {
      for (Eigen::Index m = 0; m < coupled.size(); ++m) {
        const std::complex<double> rate = solver.eigenvalues()[m];
        const auto vector = solver.eigenvectors().col(m).eval();
        if (paired && rate.imag() > 0.0) {
          add(coupled, vector.real(), {rate.real(), rate.imag(), -1.0});
          add(coupled, vector.imag(), {rate.real(), rate.imag(), -1.0});
        }
        if (!paired && rate.imag() == 0.0) add(coupled, vector.real(), rate.real());
      }
      for (Eigen::Index i = 0; i < mate.size(); ++i) {
        if (mate[i] <= i) continue;
        const Rows rows = (Rows(2) << i, mate[i]).finished();
        const OscillatorModes modes(part(A, rows));
        if (modes.pair != paired) continue;
        for (Eigen::Index k = 0; k < 2; ++k) add(rows, modes.vectors.col(k), modes.rates[k]);
      }
      if (paired) pairs = static_cast<int>(at / 2);
    }
    return true;
  }
  static Part part(const Matrix& A, const Rows& rows) {
    Part own(rows.size(), rows.size());
    for (Eigen::Index i = 0; i < rows.size(); ++i) {
      for (Eigen::Index j = 0; j < rows.size(); ++j) own(i, j) = A(rows[i], rows[j]);
    }
    return own;
  }
  /// For each row, the one other row that it is coupled with, if there is no further coupling; otherwise itself.
  static Rows mates(const Matrix& A) {
    Rows only(A.rows());
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      int count = 0;
      for (Eigen::Index j = 0; j < A.rows(); ++j) {
        if (j == i || (A(i, j) == 0.0 && A(j, i) == 0.0)) continue;
        only[i] = j;
        ++count;
      }
      if (count != 1) only[i] = i;
    }
    Rows mate = only;
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      if (only[only[i]] != i) mate[i] = i;
    }
    return mate;
  }
  static Rows rows_without(const Rows& mate) {
    Rows rows(mate.size());
    Eigen::Index count = 0;
    for (Eigen::Index i = 0; i < mate.size(); ++i) {
      if (mate[i] == i) rows[count++] = i;
    }
    rows.conservativeResize(count);
    return rows;
  }
};

}  // namespace spring_workbench::exponential
