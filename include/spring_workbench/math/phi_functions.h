#pragma once

#include <array>
#include <complex>

namespace spring_workbench::math {

/// The φ-functions of exponential integrators, φ₀ … φ₅: φ₀ = eᶻ, φ_{k+1} = (φ_k − 1/k!) / z, or
/// φ_{k+1}(z) = ∫₀¹ e^{(1−c)z} cᵏ/k! dc. Exact to rounding also near z = 0. `Scalar` is double or std::complex<double>.
template <typename Scalar>
std::array<Scalar, 6> phi_functions(Scalar z) {
  std::array<Scalar, 6> phi;
  phi[0] = std::exp(z);
  constexpr double factorial[5] = {1.0, 1.0, 2.0, 6.0, 24.0};
  if (std::norm(z) < 1.0) {
    // φ₅ by its series 1/5! + z/6! + …, the others from it upwards without cancellation.
    Scalar sum = 1.0;
    for (int n = 20; n > 5; --n) sum = 1.0 + sum * z * (1.0 / n);
    phi[5] = sum * (1.0 / 120.0);
    for (std::size_t k = 4; k > 0; --k) phi[k] = phi[k + 1] * z + 1.0 / factorial[k];
  } else {
    const Scalar inverse = 1.0 / z;
    for (std::size_t k = 0; k < 5; ++k) phi[k + 1] = (phi[k] - 1.0 / factorial[k]) * inverse;
  }
  return phi;
}

}  // namespace spring_workbench::math
