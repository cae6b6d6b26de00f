#pragma once

#include <array>
#include <cmath>
#include <complex>

namespace spring_workbench::exponential {

/// The φ-functions of exponential integrators, φ₀ … φ_highest: φ₀ = eᶻ, φ_{k+1} = (φ_k − 1/k!) / z, or
/// φ_{k+1}(z) = ∫₀¹ e^{(1−c)z} cᵏ/k! dc. Up to φ₅ exact to rounding, also near z = 0. `Scalar` is double,
/// std::complex<double> or GeneralComplex.
template <std::size_t highest, typename Scalar>
std::array<Scalar, highest + 1> phi_functions(Scalar z) {
  using std::exp, std::norm;
  std::array<Scalar, highest + 1> phi{};
  phi[0] = exp(z);
  std::array<double, highest + 1> inverse_factorial{1.0};
  for (std::size_t k = 1; k <= highest; ++k) inverse_factorial[k] = inverse_factorial[k - 1] / static_cast<double>(k);
  if (norm(z) < 1.0) {
    // φ_highest by its series 1/highest! + z/(highest + 1)! + …, the others from it upwards without cancellation.
    Scalar sum = 1.0;
    for (int n = static_cast<int>(highest) + 15; n > static_cast<int>(highest); --n) sum = 1.0 + sum * z * (1.0 / n);
    phi[highest] = sum * inverse_factorial[highest];
    for (std::size_t k = highest - 1; k > 0; --k) phi[k] = phi[k + 1] * z + inverse_factorial[k];
  } else {
    const Scalar inverse = 1.0 / z;
    for (std::size_t k = 0; k < highest; ++k) phi[k + 1] = (phi[k] - inverse_factorial[k]) * inverse;
  }
  return phi;
}

}  // namespace spring_workbench::exponential
