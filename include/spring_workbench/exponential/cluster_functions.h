#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "spring_workbench/exponential/collocation.h"
#include "spring_workbench/exponential/modal_rates.h"

namespace spring_workbench::exponential {

/// The matrix of a cluster of rates, or a function of it, as the scalar of Collocation::weights(). A number stands for
/// that multiple of the unit matrix. Empty: zero.
struct ClusterFunction {
  ModalRates::Matrix matrix;

  ClusterFunction& operator+=(const ClusterFunction& other) {
    if (matrix.size() == 0) {
      matrix = other.matrix;
    } else {
      matrix += other.matrix;
    }
    return *this;
  }
  friend ClusterFunction operator*(double a, const ClusterFunction& f) { return {a * f.matrix}; }
  friend ClusterFunction operator*(const ClusterFunction& f, double a) { return a * f; }
  friend ClusterFunction operator*(const ClusterFunction& f, const ClusterFunction& g) {
    return {f.matrix.lazyProduct(g.matrix)};
  }
  friend ClusterFunction operator+(const ClusterFunction& f, double a) {
    ClusterFunction sum = f;
    sum.matrix.diagonal().array() += a;
    return sum;
  }
};

/// φ₀ … φ_highest of a matrix (phi_functions.h): by the series after scaling to a norm below 1, then by as many
/// doublings as needed, φ_l(2z) = 2⁻ˡ (φ₀(z) φ_l(z) + Σ_{j=1…l} φ_j(z) / (l−j)!) (Skaflestad and Wright, Applied
/// Numerical Mathematics 59, 2009). The eigenvalues of a cluster are of similar size, so that doubling costs no digits.
template <std::size_t highest>
std::array<ClusterFunction, highest + 1> phi_functions(ClusterFunction z) {
  constexpr int terms = 15;
  const double norm = z.matrix.lpNorm<Eigen::Infinity>() * static_cast<double>(z.matrix.rows());
  int doublings = 0;
  if (std::isfinite(norm)) std::frexp(norm, &doublings);
  doublings = std::max(doublings, 0);
  z = std::ldexp(1.0, -doublings) * z;
  std::array<double, highest + 1> inverse_factorial{1.0};
  for (std::size_t k = 1; k <= highest; ++k) inverse_factorial[k] = inverse_factorial[k - 1] / static_cast<double>(k);

  std::array<ClusterFunction, highest + 1> phi;
  ClusterFunction sum = 0.0 * z + 1.0;
  for (int n = static_cast<int>(highest) + terms; n > static_cast<int>(highest); --n) sum = (1.0 / n) * (sum * z) + 1.0;
  phi[highest] = inverse_factorial[highest] * sum;
  for (std::size_t k = highest; k > 0; --k) phi[k - 1] = phi[k] * z + inverse_factorial[k - 1];
  for (; doublings > 0; --doublings) {
    for (std::size_t l = highest; l > 0; --l) {  // each from those below it, which are still those of z
      ClusterFunction doubled = phi[0] * phi[l];
      for (std::size_t j = 1; j <= l; ++j) doubled += inverse_factorial[l - j] * phi[j];
      phi[l] = std::ldexp(1.0, -static_cast<int>(l)) * doubled;
    }
    phi[0] = phi[0] * phi[0];
  }
  return phi;
}

/// Collocation::weights() of the matrix `z` of a cluster, times the step.
Collocation::Weights<ClusterFunction> cluster_weights(const ModalRates::Matrix& z);

}  // namespace spring_workbench::exponential
