#include "spring_workbench/math/singular_values.h"

#include <gtest/gtest.h>

namespace spring_workbench::math::singular_values_test {
namespace {

/// Of rank `rank`.
Matrix6d some_matrix(int rank) {
  Matrix6d A = Matrix6d::Zero();
  for (int k = 0; k < rank; ++k) {
    const Vector6d u = Vector6d::LinSpaced(1.0 + k, 3.0 - k) + Vector6d::Unit(k);
    const Vector6d v = Vector6d::LinSpaced(-2.0, 1.0 + 2.0 * k) - Vector6d::Unit(k);
    A += u * v.transpose();
  }
  return A;
}

TEST(SingularValues, AreOfTheMatrixInDecreasingOrder) {
  for (const int rank : {1, 3, 6}) {
    const Matrix6d A = some_matrix(rank);
    const SingularValues s = singular_values(A);
    EXPECT_TRUE((s.U * s.values.asDiagonal() * s.V.transpose()).isApprox(A, 1e-13)) << rank;
    EXPECT_TRUE((s.U.transpose() * s.U).isIdentity(1e-13)) << rank;
    EXPECT_TRUE((s.V.transpose() * s.V).isIdentity(1e-13)) << rank;
    EXPECT_GE(s.values.minCoeff(), 0.0) << rank;
    for (int i = 1; i < 6; ++i) EXPECT_LE(s.values[i], s.values[i - 1]) << rank;
  }
}

TEST(SingularValues, LeastSquaresIsTheShortestSolution) {
  const Vector6d b = Vector6d::LinSpaced(-1.0, 2.0);
  for (const int rank : {3, 6}) {
    const Matrix6d A = some_matrix(rank);
    const Vector6d x = least_squares(A, b);
    EXPECT_LT((A.transpose() * (A * x - b)).norm(), 1e-11 * A.squaredNorm()) << rank;
    const SingularValues s = singular_values(A);
    for (int k = rank; k < 6; ++k) EXPECT_NEAR(s.V.col(k).dot(x), 0.0, 1e-11 * (1.0 + x.norm())) << "null space " << k;
  }
}

}  // namespace
}  // namespace spring_workbench::math::singular_values_test
