#pragma once

#include <algorithm>
#include <array>

#include "spring_workbench/exponential/collocation.h"
#include "spring_workbench/exponential/modal_rates.h"
#include "spring_workbench/math/pack.h"

namespace spring_workbench::exponential {

/// Four functions of the quasi-triangular matrix of a cluster of rates, one in each lane: matrices with its blocks.
class ClusterFunctions {
 public:
  ClusterFunctions() = default;  // NOLINT(cppcoreguidelines-pro-type-member-init): see elements_
  /// `matrix` times the factor of each lane.
  ClusterFunctions(const ModalRates::Matrix& matrix, const math::Pack& factors);
  SPRING_WORKBENCH_INLINE void set_zero(int size) {
    size_ = size;
    std::fill_n(elements_.begin(), size * size, math::Pack{});
  }

  int size() const { return size_; }
  SPRING_WORKBENCH_INLINE const math::Pack& operator()(int row, int column) const { return elements_[at(row, column)]; }
  SPRING_WORKBENCH_INLINE math::Pack& operator()(int row, int column) { return elements_[at(row, column)]; }

 private:
  SPRING_WORKBENCH_INLINE std::size_t at(int row, int column) const {
    const int element = row * size_ + column;
    return static_cast<std::size_t>(element);
  }

  int size_ = 0;
  // Elements that `size_` leaves over are not set: that would cost as much as a product.
  std::array<math::Pack, static_cast<std::size_t>(ModalRates::max_modes* ModalRates::max_modes)> elements_;
};

/// φ₀ … φ_highest of a matrix (phi_functions.h), `highest` at most 2 Collocation::count: by the series, four terms at a
/// time (Paterson and Stockmeyer, SIAM Journal on Computing 2, 1973), after scaling to a norm below 1, then by as many
/// doublings as needed, φ_l(2z) = 2⁻ˡ (φ₀(z) φ_l(z) + Σ_{j=1…l} φ_j(z) / (l−j)!) (Skaflestad and Wright, Applied
/// Numerical Mathematics 59, 2009). The eigenvalues of a cluster are of similar size, so that doubling costs no digits.
using ClusterPhi = std::array<ClusterFunctions, 2 * Collocation::count + 1>;
void find_phi_functions(int highest, const ClusterFunctions& z, ClusterPhi& phi);

/// Collocation::Weights of a cluster; the nodes, or the samples, are in the lanes.
struct ClusterWeights {
  using PerNode = std::array<ClusterFunctions, Collocation::count>;
  ClusterFunctions constant, sample_constant;
  PerNode node, sample, defect;
};
/// Returns the coefficients for the matrix `z` of a cluster, times the step.
ClusterWeights cluster_weights(const ModalRates::Matrix& z);

}  // namespace spring_workbench::exponential
