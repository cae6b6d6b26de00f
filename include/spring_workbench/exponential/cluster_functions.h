#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "spring_workbench/exponential/collocation.h"
#include "spring_workbench/exponential/modal_rates.h"

namespace spring_workbench::exponential {

/// Product of two quasi-triangular matrices with the same blocks, as of a real Schur form: functions of one matrix.
inline ModalRates::Matrix quasi_triangular_product(const ModalRates::Matrix& a, const ModalRates::Matrix& b) {
  const Eigen::Index n = a.rows();
  ModalRates::Matrix product = ModalRates::Matrix::Zero(n, n);
  for (Eigen::Index column = 0; column < n; ++column) {
    for (Eigen::Index k = 0; k < std::min(column + 2, n); ++k) {
      const double factor = b(k, column);
      for (Eigen::Index row = 0; row < std::min(k + 2, n); ++row) product(row, column) += a(row, k) * factor;
    }
  }
  return product;
}

/// The quasi-triangular matrix of a cluster of rates, or a function of it, as the scalar of Collocation::weights(). A
/// number stands for that multiple of the unit matrix. Empty: zero.
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
    return {quasi_triangular_product(f.matrix, g.matrix)};
  }
  friend ClusterFunction operator+(const ClusterFunction& f, double a) {
    ClusterFunction sum = f;
    sum.matrix.diagonal().array() += a;
    return sum;
  }
};

/// φ₀ … φ_highest of a matrix (phi_functions.h): by the series, four terms at a time (Paterson and Stockmeyer, SIAM
/// Journal on Computing 2, 1973), after scaling to a norm below 1, then by as many doublings as needed, φ_l(2z) =
/// 2⁻ˡ (φ₀(z) φ_l(z) + Σ_{j=1…l} φ_j(z) / (l−j)!) (Skaflestad and Wright, Applied Numerical Mathematics 59, 2009). The
/// eigenvalues of a cluster are of similar size, so that doubling costs no digits.
template <std::size_t highest>
std::array<ClusterFunction, highest + 1> phi_functions(ClusterFunction z) {
  const double norm = z.matrix.cwiseAbs().colwise().sum().maxCoeff();
  int doublings = 0;
  if (std::isfinite(norm)) std::frexp(norm, &doublings);
  doublings = std::max(doublings, 0);
  z = std::ldexp(1.0, -doublings) * z;
  std::array<double, highest + 1> inverse_factorial{1.0};
  for (std::size_t k = 1; k <= highest; ++k) inverse_factorial[k] = inverse_factorial[k - 1] / static_cast<double>(k);

  std::array<ClusterFunction, highest + 1> phi;
  const ClusterFunction z2 = z * z, z3 = z2 * z, z4 = z2 * z2;
  std::array<double, 16> terms{inverse_factorial[highest]};  // zⁿ / (highest + n)!
  for (std::size_t n = 1; n < terms.size(); ++n) terms[n] = terms[n - 1] / static_cast<double>(highest + n);
  for (std::size_t n = terms.size(); n > 0; n -= 4) {
    ClusterFunction four{terms[n - 3] * z.matrix + terms[n - 2] * z2.matrix + terms[n - 1] * z3.matrix};
    if (n < terms.size()) four += phi[highest] * z4;
    phi[highest] = four + terms[n - 4];
  }
  for (std::size_t k = highest; k > 0; --k) phi[k - 1] = phi[k] * z + inverse_factorial[k - 1];
  for (; doublings > 0; --doublings) {
    for (std::size_t l = highest; l > 0; --l) {  // each from those below it, which are still those of z
      ClusterFunction doubled = phi[0] * phi[l];
      for (std::size_t j = 1; j <= l; ++j) doubled.matrix += inverse_factorial[l - j] * phi[j].matrix;
      phi[l].matrix = std::ldexp(1.0, -static_cast<int>(l)) * doubled.matrix;
    }
    phi[0] = phi[0] * phi[0];
  }
  return phi;
}

/// Collocation::weights() of the matrix `z` of a cluster, times the step.
Collocation::Weights<ClusterFunction> cluster_weights(const ModalRates::Matrix& z);

}  // namespace spring_workbench::exponential
