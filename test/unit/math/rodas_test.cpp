// The coefficients of RODASP against the conditions of a stiffly accurate Rosenbrock method of order four (Hairer and
// Wanner, Solving Ordinary Differential Equations II, section IV.7).
#include "spring_workbench/math/rodas.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace spring_workbench::math {
namespace {

constexpr int s = Rodas::stages;
using Square = Eigen::Matrix<double, s, s>;
using Vector = Eigen::Matrix<double, s, 1>;

TEST(Rodas, MeetsTheConditionsOfOrderFour) {
  Square a, c;
  for (int i = 0; i < s; ++i) {
    for (int j = 0; j < s; ++j) {
      a(i, j) = Rodas::a_ij[i][j];
      c(i, j) = Rodas::c_ij[i][j];
    }
  }
  // Back from the stages U = Γ k, in which the method is written.
  const Square inverse = Square::Identity() / Rodas::gamma - c, Gamma = inverse.inverse(), A = a * Gamma, B = A + Gamma;
  Vector m = a.row(s - 1).transpose();
  m[s - 1] += 1.0;
  const Vector b = Gamma.transpose() * m, alpha = A.rowwise().sum(), beta = B.rowwise().sum();
  const Vector gamma = Gamma.rowwise().sum();
  constexpr double rounding = 1e-12;
  for (int i = 0; i < s; ++i) {
    EXPECT_NEAR(alpha[i], Rodas::alpha[i], rounding) << i;
    EXPECT_NEAR(gamma[i], Rodas::gamma_t[i], rounding) << i;
  }
  EXPECT_NEAR(b.sum(), 1.0, rounding);
  EXPECT_NEAR(b.dot(beta), 1.0 / 2.0, rounding);
  EXPECT_NEAR(b.dot(alpha.cwiseAbs2()), 1.0 / 3.0, rounding);
  EXPECT_NEAR(b.dot(B * beta), 1.0 / 6.0, rounding);
  EXPECT_NEAR(b.dot(alpha.cwiseProduct(alpha.cwiseAbs2())), 1.0 / 4.0, rounding);
  EXPECT_NEAR(b.dot(alpha.cwiseProduct(A * beta)), 1.0 / 8.0, rounding);
  EXPECT_NEAR(b.dot(B * alpha.cwiseAbs2()), 1.0 / 12.0, rounding);
  EXPECT_NEAR(b.dot(B * (B * beta)), 1.0 / 24.0, rounding);
  // Stiffly accurate: the weights are the last row, so that R(∞) = 0.
  EXPECT_LT((b.transpose() - B.row(s - 1)).norm(), rounding);
}

}  // namespace
}  // namespace spring_workbench::math
