#include "spring_workbench/math/so3.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_poses.h"

namespace spring_workbench::math::so3_test {
namespace {

using test_support::Random;
using Matrix3l = Eigen::Matrix<long double, 3, 3>;
using Vector3l = Eigen::Matrix<long double, 3, 1>;

constexpr double pi = 3.14159265358979323846;

Matrix3l skew_l(const Vector3l& v) {
  Matrix3l m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Σ [θ]ⁿ (±1)ⁿ / (n + shift)!: exp for shift 0, the right Jacobian for shift 1 and sign −1. In extended precision.
Matrix3l power_series(const Vector3l& theta, int shift, long double sign) {
  Matrix3l term = Matrix3l::Identity(), total = Matrix3l::Zero();
  for (int n = 0; n < 80; ++n) {
    total += term;
    term = term * skew_l(theta) * (sign / static_cast<long double>(n + 1 + shift));
  }
  return total;
}

/// Angles on both sides of the switch from series to closed form at θ² = 1e-2, and everywhere else.
std::vector<double> angles() {
  return {0.0,        1e-300, 1e-160,     1e-12,  1e-8, 1e-5, 1e-3, 0.03, 0.0999,
          0.09999999, 0.1,    0.10000001, 0.1001, 0.3,  1.0,  2.0,  3.0,  pi};
}

TEST(So3, SkewIsTheCrossProduct) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vector3d a = random.vector(2.0), b = random.vector(2.0);
    EXPECT_EQ(skew(a) * b, a.cross(b));
    EXPECT_EQ(skew(a).transpose(), -skew(a));
  }
}

TEST(So3, ExpIsThePowerSeriesAndARotation) {
  Random random(2);
  for (const double angle : angles()) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d theta = angle * random.direction();
      const Matrix3d R = exp_so3(theta);
      EXPECT_LT((R.cast<long double>() - power_series(theta.cast<long double>(), 0, 1)).norm(), 2e-15L) << angle;
      EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 2e-15);
      EXPECT_NEAR(R.determinant(), 1.0, 2e-15);
    }
  }
}

TEST(So3, TurnsAboutOneAxisAdd) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Vector3d axis = random.direction();
    const double a = random.number(-10.0, 10.0), b = random.number(-10.0, 10.0);
    EXPECT_LT((exp_so3(a * axis) * exp_so3(b * axis) - exp_so3((a + b) * axis)).norm(), 3e-14);
  }
}

TEST(So3, LogUndoesExpBelowAHalfTurn) {
  Random random(4);
  for (const double angle : angles()) {
    if (angle >= pi) continue;
    for (int i = 0; i < 50; ++i) {
      const Vector3d theta = angle * random.direction();
      EXPECT_LT((log_so3(exp_so3(theta)) - theta).norm(), 4e-15 * (1.0 + angle)) << angle;
    }
  }
}

TEST(So3, ExpUndoesLogForEveryRotationAlsoAtAHalfTurn) {
  Random random(5);
  std::vector<Matrix3d> rotations = {Matrix3d::Identity()};
  for (int k = 0; k < 3; ++k) rotations.push_back(Eigen::AngleAxisd(pi, Vector3d::Unit(k)).toRotationMatrix());
  for (int k = 0; k < 3; ++k)
    rotations.push_back(2.0 * Vector3d::Unit(k) * Vector3d::Unit(k).transpose() - Matrix3d::Identity());
  for (int i = 0; i < 500; ++i) {
    rotations.push_back(random.rotation());
    const Vector3d axis = random.direction();
    rotations.push_back(2.0 * axis * axis.transpose() - Matrix3d::Identity());  // a half turn
    rotations.push_back(Eigen::AngleAxisd(pi - random.number(-1e-7, 1e-7), axis).toRotationMatrix());
  }
  for (const Matrix3d& R : rotations) {
    const Vector3d theta = log_so3(R);
    EXPECT_LE(theta.norm(), pi + 1e-15);
    EXPECT_LT((exp_so3(theta) - R).norm(), 5e-15);
  }
}

TEST(So3, TheRightJacobianIsItsPowerSeries) {
  Random random(6);
  for (const double angle : angles()) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d theta = angle * random.direction();
      const Matrix3l exact = power_series(theta.cast<long double>(), 1, -1);
      EXPECT_LT((right_jacobian_so3(theta).cast<long double>() - exact).norm(), 3e-15L) << angle;
    }
  }
}

TEST(So3, TheInverseOfTheRightJacobianIsItsInverse) {
  Random random(7);
  for (const double angle : angles()) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d theta = angle * random.direction();
      const Matrix3d product = right_jacobian_so3(theta) * right_jacobian_inverse_so3(theta);
      EXPECT_LT((product - Matrix3d::Identity()).norm(), 2e-14) << angle;
    }
  }
}

/// R(θ + h v) = R(θ) exp(h J_r v + O(h²)): the body rate of a moving rotation vector.
TEST(So3, TheRightJacobianGivesTheBodyRate) {
  Random random(8);
  for (const double angle : {1e-6, 0.05, 0.0999, 0.1001, 1.0, 3.0}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3l theta = (angle * random.direction()).cast<long double>();
      const Vector3l rate = random.vector(1.0).cast<long double>();
      const auto slope = [&](long double h) {  // vee of Rᵀ (R(t+h) − R(t−h)) / 2h
        const Matrix3l S = power_series(theta, 0, 1).transpose() *
                           (power_series(theta + h * rate, 0, 1) - power_series(theta - h * rate, 0, 1)) / (2 * h);
        return Vector3l((S(2, 1) - S(1, 2)) / 2, (S(0, 2) - S(2, 0)) / 2, (S(1, 0) - S(0, 1)) / 2);
      };
      constexpr long double h = 1e-3L;
      const Vector3l rate_W = (4 * slope(h / 2) - slope(h)) / 3;  // Richardson
      const Vector3d expected = right_jacobian_so3(theta.cast<double>()) * rate.cast<double>();
      EXPECT_LT((rate_W.cast<double>() - expected).norm(), 1e-12) << angle;
    }
  }
}

TEST(So3, TheRateOfTheRightJacobianIsItsDerivative) {
  Random random(9);
  for (const double angle : {0.0, 1e-9, 1e-4, 0.05, 0.0999, 0.1001, 0.5, 1.0, 2.0, 3.1}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3d theta = angle * random.direction(), theta_dot = random.vector(1.0), v = random.vector(1.0);
      const auto slope = [&](long double h) {
        const Vector3l t = theta.cast<long double>(), d = theta_dot.cast<long double>();
        return Vector3l((power_series(t + h * d, 1, -1) - power_series(t - h * d, 1, -1)) * v.cast<long double>() /
                        (2 * h));
      };
      constexpr long double h = 1e-3L;
      const Vector3d exact = ((4 * slope(h / 2) - slope(h)) / 3).cast<double>();
      EXPECT_LT((right_jacobian_rate_so3(theta, theta_dot, v) - exact).norm(), 2e-12) << angle;
    }
  }
}

TEST(So3, NothingJumpsWhereTheSeriesEnds) {
  Random random(10);
  for (int i = 0; i < 100; ++i) {
    const Vector3d axis = random.direction(), rate = random.vector(1.0), v = random.vector(1.0);
    const Vector3d below = 0.1 * (1.0 - 1e-14) * axis, above = 0.1 * (1.0 + 1e-14) * axis;
    EXPECT_LT((exp_so3(below) - exp_so3(above)).norm(), 1e-14);
    EXPECT_LT((right_jacobian_so3(below) - right_jacobian_so3(above)).norm(), 1e-14);
    EXPECT_LT((right_jacobian_inverse_so3(below) - right_jacobian_inverse_so3(above)).norm(), 1e-14);
    EXPECT_LT((right_jacobian_rate_so3(below, rate, v) - right_jacobian_rate_so3(above, rate, v)).norm(), 1e-12);
  }
}

TEST(So3, WhatHasNoAxisIsFinite) {
  const Vector3d zero = Vector3d::Zero(), v(1.0, 2.0, 3.0);
  EXPECT_EQ(exp_so3(zero), Matrix3d::Identity());
  EXPECT_EQ(log_so3(Matrix3d::Identity()), zero);
  EXPECT_EQ(right_jacobian_so3(zero), Matrix3d::Identity());
  EXPECT_EQ(right_jacobian_inverse_so3(zero), Matrix3d::Identity());
  EXPECT_TRUE(right_jacobian_rate_so3(zero, v, v).isZero());
  const Vector3d w(3.0, 1.0, 2.0);
  EXPECT_TRUE(right_jacobian_rate_so3(zero, v, w).isApprox(-0.5 * v.cross(w)));
}

}  // namespace
}  // namespace spring_workbench::math::so3_test
