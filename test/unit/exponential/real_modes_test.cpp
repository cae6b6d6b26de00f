// The modes of a matrix: A V = V B, or none.
#include "spring_workbench/exponential/real_modes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

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

/// φ₀(A) … φ₅(A): the blocks of the first row of the exponential of A with unit matrices above the diagonal.
test_support::LongMatrix phi_functions_of(const Eigen::Matrix2d& A) {
  test_support::LongMatrix C = test_support::LongMatrix::Zero(12, 12);
  C.topLeftCorner(2, 2) = A.cast<long double>();
  C.topRightCorner(10, 10).setIdentity();
  return test_support::exponential(C);
}

TEST(RealModes, MakeTheMatrixAgain) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int pairs = 0, real = 0;
  for (int i = 0; i < 500; ++i) {
    const Matrix4 mixed = Matrix4::Identity() + 0.3 * Matrix4::NullaryExpr([&] { return unit(random); });
    const Matrix4 A = oscillators(std::pow(10.0, 2.0 * unit(random)), 1.0 + 0.9 * unit(random),
                                  std::pow(10.0, 2.0 * unit(random)), 1.0 + 0.9 * unit(random), mixed);
    const RealModes<Matrix4> modes(A);
    ASSERT_TRUE(std::isfinite(modes.condition)) << i;
    EXPECT_LT((modes.vectors * modes.blocks() * modes.inverse - A).norm(), 1e-14 * modes.condition * A.norm()) << i;
    pairs += modes.pairs;
    real += 2 - modes.pairs;
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
    const RealModes<Matrix2> modes(A);
    EXPECT_LE((modes.vectors * modes.blocks() * modes.inverse - A).norm(), 2e-15 * A.norm()) << A;
    EXPECT_LT(modes.condition, 5.3) << A;  // 2: orthonormal
    ++(modes.pairs > 0 ? pairs : real);
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
    const RealModes<Eigen::Matrix2d> modes(A);
    const test_support::LongMatrix exact = phi_functions_of(A);
    std::array<Eigen::Matrix2d, 6> of_blocks;
    if (modes.pairs > 0) {
      const auto phi = phi_functions<5>(modes.rates[0]);
      for (std::size_t k = 0; k < phi.size(); ++k) {
        of_blocks[k] << phi[k].re, phi[k].im, modes.rates[0].square * phi[k].im, phi[k].re;
      }
    } else {
      const auto phi = phi_functions<5>(modes.rates[0].re), other = phi_functions<5>(modes.rates[1].re);
      for (std::size_t k = 0; k < phi.size(); ++k) of_blocks[k] << phi[k], 0.0, 0.0, other[k];
    }
    for (std::size_t k = 0; k < of_blocks.size(); ++k) {
      const Eigen::Matrix2d wrong = modes.vectors * of_blocks[k] * modes.inverse -
                                    exact.block(0, 2 * static_cast<Eigen::Index>(k), 2, 2).cast<double>();
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
  const RealModes<Matrix8> modes(A);
  EXPECT_EQ(modes.pairs, 3);
  EXPECT_LT(modes.condition, 30.0);
  EXPECT_LT((modes.vectors * modes.blocks() * modes.inverse - A).norm(), 1e-14 * A.norm());
  for (int m = 0; m < 8; ++m) {
    int of = 0;  // which of the three parts it has a share of
    if (modes.vectors(0, m) != 0.0 || modes.vectors(4, m) != 0.0) ++of;
    if (modes.vectors(2, m) != 0.0 || modes.vectors(6, m) != 0.0) ++of;
    if (modes.vectors(1, m) != 0.0 || modes.vectors(5, m) != 0.0) ++of;
    EXPECT_EQ(of, 1) << modes.vectors;
  }
}

/// Of coupled ones that are critical there may be fewer vectors than rates, which rounding may make anything of: what
/// is given as modes are some.
TEST(RealModes, WhereThereAreNoneAreNoneOrMakeTheMatrixAgain) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int none = 0, poor = 0;
  for (int i = 0; i < 50000; ++i) {
    const double omega = std::pow(10.0, 3.0 * unit(random));
    Matrix4 A = oscillators(omega, 1.0, omega * (i % 2 == 0 ? 1.0 : 3.0), 1.0, Matrix4::Identity());
    A(3, 0) = omega * unit(random);
    const RealModes<Matrix4> modes(A);
    ++(modes.condition < 1e300 ? poor : none);
    if (!(modes.condition < 1e300)) continue;
    EXPECT_LT((A * modes.vectors - modes.vectors * modes.blocks()).norm(), 1e-11 * A.norm() * modes.vectors.norm());
  }
  EXPECT_GT(none, 20);
  EXPECT_GT(poor, 20);
}

TEST(RealModes, OfWhatIsNotFiniteAreNaN) {
  Matrix4 A = Matrix4::Identity();
  A(1, 2) = std::numeric_limits<double>::infinity();
  const RealModes<Matrix4> modes(A);
  EXPECT_TRUE(std::isnan(modes.condition));
  EXPECT_FALSE(modes.vectors.allFinite());
}

}  // namespace
}  // namespace spring_workbench::exponential::real_modes_test
