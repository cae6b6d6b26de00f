#include "spring_workbench/math/phi_functions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "spring_workbench/math/quadrature.h"

namespace spring_workbench::math::phi_functions_test {
namespace {

using Complex = std::complex<double>;

TEST(PhiFunctions, AreTheirIntegrals) {
  // φ_{k+1}(z) = ∫₀¹ e^{(1−c)z} cᵏ/k! dc, by Gauss quadrature over eight pieces.
  const GaussLegendre<8> gauss;
  for (const double length : {0.0, 1e-9, 1e-3, 0.3, 0.999, 1.001, 3.0, 20.0}) {
    for (const double angle : {M_PI, 2.5, 0.5 * M_PI, -2.0}) {
      const Complex z = std::polar(length, angle);
      const auto phi = phi_functions<5>(z);
      double factorial = 1.0;
      for (int k = 0; k < 5; ++k) {
        if (k > 0) factorial *= k;
        Complex integral = 0.0;
        for (int piece = 0; piece < 8; ++piece) {
          for (int i = 0; i < 8; ++i) {
            const double c = (piece + gauss.nodes[i]) / 8.0;
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

}  // namespace
}  // namespace spring_workbench::math::phi_functions_test
