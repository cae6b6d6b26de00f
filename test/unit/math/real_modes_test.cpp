// The modes of a matrix: A V = V B, or none.
#include "spring_workbench/math/real_modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace spring_workbench::math::real_modes_test {
namespace {

using Matrix4 = Eigen::Matrix4d;

/// Two oscillators, of these rates and damping ratios, seen from mixed coordinates.
Matrix4 oscillators(double omega, double zeta, double other_omega, double other_zeta, const Matrix4& mixed) {
  Matrix4 A = Matrix4::Zero();
  A.block<2, 2>(0, 0) << 0.0, omega, -omega, -2.0 * zeta * omega;
  A.block<2, 2>(2, 2) << 0.0, other_omega, -other_omega, -2.0 * other_zeta * other_omega;
  return mixed * A * mixed.inverse();
}

Matrix4 blocks(const RealModes<Matrix4>& modes) {
  Matrix4 B = Matrix4::Zero();
  for (int i = 0; i < 4; ++i) B(i, i) = modes.rates[i].real();
  for (int i = 0; i < 2 * modes.pairs; i += 2) {
    B(i, i + 1) = modes.rates[i].imag();
    B(i + 1, i) = -modes.rates[i].imag();
  }
  return B;
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
    EXPECT_LT((modes.vectors * blocks(modes) * modes.inverse - A).norm(), 1e-14 * modes.condition * A.norm()) << i;
    pairs += modes.pairs;
    real += 2 - modes.pairs;
  }
  EXPECT_GT(pairs, 100);
  EXPECT_GT(real, 100);
}

/// At critical damping there is one eigenvector for two rates, which rounding may make anything of: what is given as
/// modes are some.
TEST(RealModes, WhereThereAreNoneAreNoneOrMakeTheMatrixAgain) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int none = 0, poor = 0;
  for (int i = 0; i < 50000; ++i) {
    Eigen::Matrix2d A;  // as rounding leaves it
    const double omega = std::pow(10.0, 3.0 * unit(random)), last = std::numeric_limits<double>::epsilon();
    A << 0.0, omega, -omega * (1.0 + last * std::round(8.0 * unit(random))),
        -2.0 * omega * (1.0 + last * std::round(2.0 * unit(random)));
    const RealModes<Eigen::Matrix2d> modes(A);
    ++(modes.condition < 1e300 ? poor : none);
    if (!(modes.condition < 1e300)) continue;
    Eigen::Matrix2d B;
    const double a = modes.rates[0].real(), b = modes.rates[0].imag();
    B << a, modes.pairs > 0 ? b : 0.0, modes.pairs > 0 ? -b : 0.0, modes.rates[1].real();
    EXPECT_LT((A * modes.vectors - modes.vectors * B).norm(), 1e-11 * A.norm() * modes.vectors.norm()) << i;
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
}  // namespace spring_workbench::math::real_modes_test
