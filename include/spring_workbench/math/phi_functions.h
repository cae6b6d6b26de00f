#pragma once

#include <array>
#include <cmath>
#include <complex>

namespace spring_workbench::math {

/// The φ-functions of exponential integrators, φ₀ … φ_most: φ₀ = eᶻ, φ_{k+1} = (φ_k − 1/k!) / z, or
/// φ_{k+1}(z) = ∫₀¹ e^{(1−c)z} cᵏ/k! dc. Up to φ₅ exact to rounding, also near z = 0. `Scalar` is double,
/// std::complex<double> or GeneralComplex.
template <std::size_t most, typename Scalar>
std::array<Scalar, most + 1> phi_functions(Scalar z) {
  using std::exp, std::norm;
  std::array<Scalar, most + 1> phi{};
  phi[0] = exp(z);
  std::array<double, most + 1> inverse_factorial{1.0};
  for (std::size_t k = 1; k <= most; ++k) inverse_factorial[k] = inverse_factorial[k - 1] / static_cast<double>(k);
  if (norm(z) < 1.0) {
    // φ_most by its series 1/most! + z/(most + 1)! + …, the others from it upwards without cancellation.
    Scalar sum = 1.0;
    for (int n = static_cast<int>(most) + 15; n > static_cast<int>(most); --n) sum = 1.0 + sum * z * (1.0 / n);
    phi[most] = sum * inverse_factorial[most];
    for (std::size_t k = most - 1; k > 0; --k) phi[k] = phi[k + 1] * z + inverse_factorial[k];
  } else {
    const Scalar inverse = 1.0 / z;
    for (std::size_t k = 0; k < most; ++k) phi[k + 1] = (phi[k] - inverse_factorial[k]) * inverse;
  }
  return phi;
}

}  // namespace spring_workbench::math
