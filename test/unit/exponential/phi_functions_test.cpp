#include "spring_workbench/exponential/phi_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "spring_workbench/exponential/general_complex.h"
#include "spring_workbench/math/quadrature.h"

namespace spring_workbench::exponential::phi_functions_test {
namespace {

using Complex = std::complex<double>;

TEST(PhiFunctions, AreTheirIntegrals) {
  // φ_{k+1}(z) = ∫₀¹ e^{(1−c)z} cᵏ/k! dc, by Gauss quadrature over eight parts.
  const math::GaussLegendre<8> gauss;
  for (const double length : {0.0, 1e-9, 1e-3, 0.3, 0.999, 1.001, 3.0, 20.0}) {
    for (const double angle : {M_PI, 2.5, 0.5 * M_PI, -2.0}) {
      const Complex z = std::polar(length, angle);
      const auto phi = phi_functions<5>(z);
      double factorial = 1.0;
      for (int k = 0; k < 5; ++k) {
        if (k > 0) factorial *= k;
        Complex integral = 0.0;
        for (int part = 0; part < 8; ++part) {
          for (int i = 0; i < 8; ++i) {
            const double c = (part + gauss.nodes[i]) / 8.0;
            integral += gauss.weights[i] / 8.0 * std::exp((1.0 - c) * z) * std::pow(c, k) / factorial;
          }
        }
        EXPECT_LT(std::abs(phi[static_cast<std::size_t>(k) + 1] - integral), 2e-15) << z << " " << k + 1;
      }
      EXPECT_LT(std::abs(phi[0] - std::exp(z)), 1e-15);
    }
  }
}

TEST(PhiFunctions, RealAndComplexAgree) {
  for (const double z : {0.0, -1e-5, -0.7, -1.5, -40.0, -1e6}) {
    const auto real = phi_functions<5>(z);
    const auto complex = phi_functions<5>(Complex(z));
    for (std::size_t k = 0; k < real.size(); ++k) EXPECT_LT(std::abs(real[k] - complex[k]), 1e-15) << z << " " << k;
  }
}

/// φ of a matrix re I + im J, J² = square I: where J has eigenvalues ±√square, they are φ of those of the matrix.
TEST(PhiFunctions, OfGeneralComplexNumbersAreThoseOfTheEigenvalues) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const double re = -std::pow(10.0, 3.0 * unit(random)), im = 2.0 * re * unit(random), square = 0.04 * unit(random);
    const double apart = im * std::sqrt(std::abs(square));
    const auto phi = phi_functions<5>(GeneralComplex(re, im, square));
    for (std::size_t k = 0; k < phi.size(); ++k) {
      Complex above, below;
      if (square < 0.0) {
        above = phi_functions<5>(Complex(re, apart))[k];
        below = std::conj(above);
      } else {
        above = phi_functions<5>(re + apart)[k];
        below = phi_functions<5>(re - apart)[k];
      }
      const double root = std::sqrt(std::abs(square));
      const double other = square < 0.0 ? above.imag() / root : 0.5 * (above - below).real() / root;
      EXPECT_NEAR(phi[k].re, 0.5 * (above + below).real(), 1e-14) << re << " " << im << " " << square << " " << k;
      EXPECT_NEAR(phi[k].im, other, 1e-14 / root) << re << " " << im << " " << square << " " << k;
    }
  }
}

/// At coincident eigenvalues the other part is the derivative: φ_k' = φ_k − k φ_{k+1} (from the integral, by parts).
TEST(PhiFunctions, OfDualNumbersAreDerivatives) {
  for (const double z : {0.0, -1e-9, -0.3, -0.999, -1.001, -7.0, -1e4}) {
    for (const double square : {0.0, 1e-30, -1e-30}) {
      const auto phi = phi_functions<5>(GeneralComplex(z, 3.0, square));
      const auto of_mean = phi_functions<6>(z);
      for (std::size_t k = 0; k < phi.size(); ++k) {
        EXPECT_NEAR(phi[k].re, of_mean[k], 1e-15) << z << " " << k;
        EXPECT_NEAR(phi[k].im, 3.0 * (of_mean[k] - static_cast<double>(k) * of_mean[k + 1]), 1e-14) << z << " " << k;
      }
    }
  }
}

}  // namespace
}  // namespace spring_workbench::exponential::phi_functions_test
