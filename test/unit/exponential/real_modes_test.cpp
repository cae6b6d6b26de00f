// The modes of a matrix: A V = V B, with well-conditioned V.
#include "spring_workbench/exponential/real_modes.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <random>

#include "spring_workbench/exponential/cluster_functions.h"
#include "spring_workbench/exponential/phi_functions.h"
#include "support/matrix_exponential.h"

namespace spring_workbench::exponential::real_modes_test {
namespace {

using Matrix4 = Eigen::Matrix4d;

/// Two oscillators, of these rates and damping ratios, seen from mixed coordinates.
Matrix4 oscillators(double omega, double zeta, double other_omega, double other_zeta, const Matrix4& mixed) {
  Matrix4 A = Matrix4::Zero();
  A.block<2, 2>(0, 0) << 0.0, omega, -omega, -2.0 * zeta * omega;
  A.block<2, 2>(2, 2) << 0.0, other_omega, -other_omega, -2.0 * other_zeta * other_omega;
  return mixed * A * mixed.inverse();
}

using Matrix = RealModes::Matrix;

/// φ_k(A) is block k of these: the first row of the exponential of A with unit matrices above the diagonal.
test_support::LongMatrix phi_functions_of(const Matrix& A) {
  const Eigen::Index n = A.rows();
  test_support::LongMatrix C = test_support::LongMatrix::Zero(6 * n, 6 * n);
  C.topLeftCorner(n, n) = A.cast<long double>();
  C.topRightCorner(5 * n, 5 * n).setIdentity();
  return test_support::exponential(C).topRows(n);
}

/// φ_k(A) by its modes.
Eigen::MatrixXd by_modes(const RealModes& modes, std::size_t k) {
  const ModalRates& rates = modes.rates;
  Eigen::MatrixXd of_blocks = Eigen::MatrixXd::Zero(rates.count(), rates.count());
  for (int m = 0; m < 2 * rates.pairs; m += 2) {
    const GeneralComplex phi = phi_functions<5>(rates.of[static_cast<std::size_t>(m)])[k];
    of_blocks.block<2, 2>(m, m) << phi.re, phi.im, phi.square * phi.im, phi.re;
  }
  for (int m = 2 * rates.pairs; m < rates.unclustered(); ++m) {
    of_blocks(m, m) = phi_functions<5>(rates.of[static_cast<std::size_t>(m)].re)[k];
  }
  int at = 0;
  for (const int size : rates.cluster_sizes) {
    if (size == 0) break;
    ClusterPhi phi;
    find_phi_functions(5, {rates.clusters.block(at, at, size, size), math::Pack{0.0, 0.5, 1.0, 0.25}}, phi);
    const int begin = rates.unclustered() + at;
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) of_blocks(begin + i, begin + j) = phi[k](i, j)[2];
    }
    at += size;
  }
  return modes.vectors * of_blocks * modes.inverse;
}

double condition(const RealModes& modes) { return modes.vectors.norm() * modes.inverse.norm(); }
double error(const RealModes& modes, const Matrix& A) {
  return (modes.vectors * modes.blocks() * modes.inverse - A).norm();
}

TEST(ClusterFunctions, OfEachLaneAreThoseOfItsMultipleOfTheMatrix) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Matrix A = Matrix::Zero(4, 4);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i <= j; ++i) A(i, j) = i == j ? -20.0 : 5.0 * unit(random);
  }
  const std::array<double, 4> factors{0.0, 0.1, 0.6, 1.0};
  ClusterPhi side_by_side, alone;
  find_phi_functions(8, {A, math::pack(factors)}, side_by_side);
  for (int lane = 0; lane < 4; ++lane) {
    find_phi_functions(8, {factors[static_cast<std::size_t>(lane)] * A, math::Pack{} + 1.0}, alone);
    for (std::size_t k = 0; k <= 8; ++k) {
      for (int i = 0; i < 4; ++i) {
        for (int j = i; j < 4; ++j) EXPECT_NEAR(side_by_side[k](i, j)[lane], alone[k](i, j)[0], 1e-14) << k << lane;
      }
    }
  }
}

TEST(RealModes, MakeTheMatrixAgain) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int pairs = 0, real = 0;
  for (int i = 0; i < 500; ++i) {
    const Matrix4 mixed = Matrix4::Identity() + 0.3 * Matrix4::NullaryExpr([&] { return unit(random); });
    const Matrix4 A = oscillators(std::pow(10.0, 2.0 * unit(random)), 1.0 + 0.9 * unit(random),
                                  std::pow(10.0, 2.0 * unit(random)), 1.0 + 0.9 * unit(random), mixed);
    const RealModes modes(A);
    EXPECT_LT(error(modes, A), 1e-14 * condition(modes) * A.norm()) << i;
    pairs += modes.rates.pairs;
    real += modes.rates.singles;
  }
  EXPECT_GT(pairs, 100);
  EXPECT_GT(real, 100);
}

/// Of one oscillator they are never nearly parallel: undamped, critical to the last bit, overdamped, pushed away.
TEST(RealModes, OfOneOscillatorAreWellConditioned) {
  using Matrix2 = Eigen::Matrix2d;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int pairs = 0, real = 0;
  const auto check = [&](const Matrix2& A) {
    const RealModes modes(A);
    EXPECT_LE(error(modes, A), 2e-15 * A.norm()) << A;
    EXPECT_LT(condition(modes), 5.3) << A;  // 2: orthonormal
    ++(modes.rates.pairs > 0 ? pairs : real);
  };
  for (int i = 0; i < 20000; ++i) {
    const double omega = std::pow(10.0, 3.0 * unit(random)), last = std::numeric_limits<double>::epsilon();
    Matrix2 A;  // as rounding leaves it
    A << 0.0, omega, -omega * (1.0 + last * std::round(8.0 * unit(random))),
        -2.0 * omega * (1.0 + last * std::round(2.0 * unit(random)));
    check(A);
    const double zeta = 1.0 + std::copysign(std::pow(10.0, -8.0 + 8.0 * unit(random)), unit(random));
    A << 0.0, omega, -omega * std::copysign(std::exp(unit(random)), unit(random) + 0.5), -2.0 * zeta * omega;
    check(A);
    check(Matrix2::NullaryExpr([&] { return unit(random); }));
  }
  EXPECT_GT(pairs, 1000);
  EXPECT_GT(real, 1000);
}

/// Two rates, real or conjugate, whatever their relative distance.
TEST(RealModes, OfOneOscillatorGiveItsExponential) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 4000; ++i) {
    const double omega = std::pow(10.0, 1.5 * unit(random));
    const double apart = i % 20 == 0 ? 0.0 : std::copysign(std::pow(10.0, -8.0 + 8.0 * unit(random)), unit(random));
    // Rates −ω and −ω (1 + apart), or −ω ± i ω |apart|.
    Eigen::Matrix2d A;
    A << 0.0, omega, apart > 0.0 ? -omega * (1.0 + apart) : -omega * (1.0 + apart * apart),
        apart > 0.0 ? -omega * (2.0 + apart) : -2.0 * omega;
    const RealModes modes(A);
    const test_support::LongMatrix exact = phi_functions_of(A);
    for (int k = 0; k <= 5; ++k) {
      const Eigen::MatrixXd wrong =
          by_modes(modes, static_cast<std::size_t>(k)) - exact.middleCols(2 * k, 2).cast<double>();
      ASSERT_LT(wrong.norm(), 2e-14) << omega << " " << apart << " " << k;
    }
  }
}

/// Those that nothing couples have modes of their own, also two that are alike and critical; the others have theirs.
TEST(RealModes, OfOscillatorsThatNothingCouplesAreTheirOwn) {
  using Matrix8 = Eigen::Matrix<double, 8, 8>;
  Matrix8 A = Matrix8::Zero();
  const auto set = [&A](int i, double omega, double zeta) {
    A(i, 4 + i) = omega;
    A(4 + i, i) = -omega;
    A(4 + i, 4 + i) = -2.0 * zeta * omega;
  };
  set(0, 3.0, 1.0);
  set(1, 5.0, 0.1);
  set(2, 3.0, 1.0);
  set(3, 7.0, 2.0);
  A(5, 3) = 1.0;
  A(7, 1) = -1.0;
  const RealModes modes(A);
  EXPECT_EQ(modes.rates.pairs, 3);
  EXPECT_LT(condition(modes), 30.0);
  EXPECT_LT(error(modes, A), 1e-14 * A.norm());
  for (int m = 0; m < 8; ++m) {
    int of = 0;  // which of the three parts it has a share of
    if (modes.vectors(0, m) != 0.0 || modes.vectors(4, m) != 0.0) ++of;
    if (modes.vectors(2, m) != 0.0 || modes.vectors(6, m) != 0.0) ++of;
    if (modes.vectors(1, m) != 0.0 || modes.vectors(5, m) != 0.0) ++of;
    EXPECT_EQ(of, 1) << modes.vectors;
  }
}

/// Coupled oscillators: two or three, alike or not, whose rates coincide, nearly coincide or do not, from the side of
/// oscillation and from the other.
Matrix nearly_critical(std::mt19937& random, double& apart) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const int n = unit(random) < 0.0 ? 2 : 3;
  const double omega = std::pow(10.0, unit(random));
  apart = unit(random) < -0.9 ? 0.0 : std::copysign(std::pow(10.0, -6.5 + 5.5 * unit(random)), unit(random));
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  const bool alike = unit(random) < 0.0;
  for (int i = 0; i < n; ++i) {
    A(i, n + i) = omega * (alike ? 1.0 : 1.0 + i);
    A(n + i, i) = -A(i, n + i);
    A(n + i, n + i) = -2.0 * (1.0 + apart * (alike ? 1.0 : unit(random))) * A(i, n + i);
  }
  // One-sided couplings do not change the rates.
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) A(n + i, j) = omega * unit(random);
  }
  // A rotation mixes the coordinates.
  const Eigen::MatrixXd mixed = Eigen::MatrixXd::NullaryExpr(2 * n, 2 * n, [&] { return unit(random); });
  const Matrix Q = Eigen::HouseholderQR<Eigen::MatrixXd>(mixed).householderQ();
  return Q * A * Q.transpose();
}

/// They never become nearly parallel, whatever the rates: with fewer vectors than rates, and across the point where
/// that happens, relative distances of 1e-12 to 0.1 on either side.
TEST(RealModes, AreWellConditionedHoweverCloseTheRates) {
  std::mt19937 random(4);
  int clusters = 0, pairs = 0;
  for (int i = 0; i < 5000; ++i) {
    double apart = 0.0;
    const Matrix A = nearly_critical(random, apart);
    const RealModes modes(A);
    EXPECT_LT(condition(modes), 3000.0) << i << " " << apart;
    EXPECT_LT(error(modes, A), 1e-13 * A.norm()) << i << " " << apart;
    EXPECT_LT((modes.vectors * modes.inverse - Matrix::Identity(A.rows(), A.rows())).norm(), 1e-12) << i;
    ++(modes.rates.clusters.size() > 0 ? clusters : pairs);
  }
  EXPECT_GT(clusters, 100);
  EXPECT_GT(pairs, 100);
}

/// φ-functions by the modes are those of the matrix, to rounding, at any distance of the rates: so also continuous in
/// it.
TEST(RealModes, GiveTheExponentialHoweverCloseTheRates) {
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    double apart = 0.0;
    const Matrix A = nearly_critical(random, apart);
    const RealModes modes(A);
    const test_support::LongMatrix exact = phi_functions_of(A);
    for (int k = 0; k <= 5; ++k) {
      const Eigen::MatrixXd phi = exact.middleCols(A.rows() * k, A.rows()).cast<double>();
      const Eigen::MatrixXd wrong = by_modes(modes, static_cast<std::size_t>(k)) - phi;
      EXPECT_LT(wrong.norm(), 1e-12) << i << " " << apart << " " << k;
    }
  }
}

TEST(RealModes, OfWhatIsNotFiniteAreNot) {
  Matrix4 A = Matrix4::Identity();
  A(1, 2) = std::numeric_limits<double>::infinity();
  const RealModes modes(A);
  EXPECT_FALSE(modes.vectors.allFinite());
  EXPECT_FALSE(modes.inverse.allFinite());
}

}  // namespace
}  // namespace spring_workbench::exponential::real_modes_test
