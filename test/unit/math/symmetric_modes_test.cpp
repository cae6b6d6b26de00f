#include "spring_workbench/math/symmetric_modes.h"

#include <gtest/gtest.h>

#include <random>

namespace spring_workbench::math::symmetric_modes_test {
namespace {

using Matrix = SymmetricModes::Matrix;

Matrix random_matrix(std::mt19937& random, Eigen::Index n) {
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(n, n, [&](Eigen::Index, Eigen::Index) { return normal(random); });
}

TEST(SymmetricModes, AreThoseOfTheMatrixInIncreasingOrder) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 600; ++trial) {
    const Matrix B = random_matrix(random, 1 + trial % 6), A = B + B.transpose();
    const SymmetricModes modes = symmetric_modes(A);
    const Matrix& X = modes.vectors;
    const Matrix left_over = A * X - X * modes.values.asDiagonal();
    EXPECT_LT(left_over.norm(), 1e-13 * A.norm());
    EXPECT_LT((X.transpose() * X - Matrix::Identity(A.rows(), A.cols())).norm(), 1e-13);
    for (Eigen::Index i = 1; i < A.rows(); ++i) EXPECT_LE(modes.values[i - 1], modes.values[i]);
  }
}

TEST(SymmetricModes, AreThoseOfTwoMatricesAndNormalisedByTheSecond) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 600; ++trial) {
    const Eigen::Index n = 1 + trial % 6;
    const Matrix B = random_matrix(random, n), K = B + B.transpose(), C = random_matrix(random, n),
                 M = C * C.transpose() + Matrix::Identity(n, n);
    const SymmetricModes modes = symmetric_modes(K, M);
    const Matrix& X = modes.vectors;
    const Matrix left_over = K * X - M * X * modes.values.asDiagonal();
    EXPECT_LT(left_over.norm(), 1e-11 * (K.norm() + M.norm() * modes.values.norm()));
    EXPECT_LT((X.transpose() * M * X - Matrix::Identity(n, n)).norm(), 1e-12);
    for (Eigen::Index i = 1; i < n; ++i) EXPECT_LE(modes.values[i - 1], modes.values[i]);
  }
}

}  // namespace
}  // namespace spring_workbench::math::symmetric_modes_test
