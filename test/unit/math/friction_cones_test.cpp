#include "spring_workbench/math/friction_cones.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

namespace spring_workbench::math::friction_cones_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Contacts between bodies of `velocities` numbers in all, whose masses lie up to `spread` apart.
struct Problem {
  MatrixXd A;
  VectorXd b;
  std::vector<double> friction;
};

Problem random_problem(std::mt19937& random, Index contacts, Index velocities, double spread) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit;
  Problem p;
  VectorXd inverse_mass(velocities), velocity(velocities);
  for (Index i = 0; i < velocities; ++i) {
    inverse_mass[i] = std::pow(spread, unit(random) - 0.5);
    velocity[i] = normal(random);
  }
  const MatrixXd J = MatrixXd::NullaryExpr(3 * contacts, velocities, [&] { return normal(random); });
  p.A = J * inverse_mass.asDiagonal() * J.transpose();
  p.b = J * velocity;  // so there is an answer: standing still is one that closes nothing
  for (Index i = 0; i < contacts; ++i) p.friction.push_back(i % 4 == 0 ? 0.0 : unit(random));
  return p;
}

/// How far impulses and rates are from Coulomb's law, as a share of the largest rate and impulse.
double violation(const Problem& p, const VectorXd& x) {
  const VectorXd y = p.A * x + p.b;
  const double rate = p.b.cwiseAbs().maxCoeff();
  const double impulse = std::max(x.cwiseAbs().maxCoeff(), rate / p.A.diagonal().maxCoeff());
  double worst = 0.0;
  for (Index i = 0; i < p.b.size(); i += 3) {
    const double most = p.friction[static_cast<std::size_t>(i / 3)] * x[i];
    const Eigen::Vector2d across = x.segment<2>(i + 1), slip = y.segment<2>(i + 1);
    worst = std::max({worst, -y[i] / rate, -x[i] / impulse, std::abs(x[i] * y[i]) / (rate * impulse),
                      (across.norm() - most) / impulse,
                      // What slips is opposed with all there is.
                      (slip * most + slip.norm() * across).norm() / (rate * impulse)});
  }
  return worst;
}

TEST(FrictionCones, KeepCoulombsLawHoweverUnlikeTheMassesAre) {
  std::mt19937 random(1);
  int solved = 0;
  for (int i = 0; i < 200; ++i) {
    const Index contacts = 1 + i % 8;
    const Problem p = random_problem(random, contacts, 6 + i % 7, i % 2 == 0 ? 1e2 : 1e6);
    VectorXd x;
    if (!solve_in_cones(p.A, p.b, p.friction, x)) continue;
    ++solved;
    EXPECT_LT(violation(p, x), 2e-6) << "problem " << i;
  }
  EXPECT_GE(solved, 180);
}

TEST(FrictionCones, AHeavyCubeOnALightOneSharesItsWeightOut) {
  // 1000 kg on 1 g on the ground, each contact one point: the upper carries the upper cube, the lower both.
  const double m_light = 1e-3, m_heavy = 1e3, fall = 0.01;
  MatrixXd A = MatrixXd::Zero(6, 6);
  for (Index k = 0; k < 3; ++k) {
    A(k, k) = 1.0 / m_light;
    A(k, k + 3) = A(k + 3, k) = -1.0 / m_light;
    A(k + 3, k + 3) = 1.0 / m_light + 1.0 / m_heavy;
  }
  VectorXd b = VectorXd::Zero(6), x;
  b[0] = -fall;  // both fall with the same speed: the upper gap stays
  ASSERT_TRUE(solve_in_cones(A, b, {0.5, 0.5}, x));
  EXPECT_NEAR(x[0], (m_light + m_heavy) * fall, 1e-6 * m_heavy * fall);
  EXPECT_NEAR(x[3], m_heavy * fall, 1e-6 * m_heavy * fall);
}

TEST(FrictionCones, SticksBelowTheAngleOfFrictionAndSlidesAbove) {
  const double friction = 0.5, angle = std::atan(friction);
  for (const double beyond : {-0.2, -0.01, 0.01, 0.2}) {
    VectorXd b(3), x;
    b << -std::cos(angle + beyond), std::sin(angle + beyond), 0.0;
    ASSERT_TRUE(solve_in_cones(MatrixXd::Identity(3, 3), b, {friction}, x));
    EXPECT_NEAR(x[0], -b[0], 1e-6);
    EXPECT_NEAR(b[1] + x[1], std::max(0.0, b[1] + friction * b[0]), 1e-6);
  }
}

TEST(FrictionCones, WhatOpensIsLeftAlone) {
  VectorXd b(3), x;
  b << 1.0, 2.0, 3.0;
  ASSERT_TRUE(solve_in_cones(MatrixXd::Identity(3, 3), b, {0.5}, x));
  EXPECT_LT(x.norm(), 1e-6);
}

TEST(FrictionCones, WithoutAnAnswerTheyAreLeftAsTheyWere) {
  const VectorXd before = VectorXd::Constant(3, 7.0);
  VectorXd x = before, b = -VectorXd::Ones(3);
  EXPECT_FALSE(solve_in_cones(MatrixXd::Zero(3, 3), b, {0.5}, x));  // it closes, and nothing gives way
  b[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solve_in_cones(MatrixXd::Identity(3, 3), b, {0.5}, x));
  EXPECT_FALSE(solve_in_cones(MatrixXd(), VectorXd(), {}, x));
  EXPECT_EQ(x, before);
}

}  // namespace
}  // namespace spring_workbench::math::friction_cones_test
