#pragma once

#include <complex>

namespace spring_workbench {

/// The φ-functions of exponential integrators: φ₀ = eᶻ, φ_{k+1} = (φ_k − 1/k!) / z. Exact to rounding also near z = 0.
struct PhiFunctions {
  std::complex<double> zero, one, two, three;
};

PhiFunctions phi_functions(std::complex<double> z);

}  // namespace spring_workbench
