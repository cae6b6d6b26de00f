#include "spring_workbench/exponential/cluster_functions.h"

#include <algorithm>
#include <cmath>

namespace spring_workbench::exponential {
namespace {

using math::Pack;

/// product += a b.
SPRING_WORKBENCH_INLINE void add_product(const ClusterFunctions& a, const ClusterFunctions& b,
                                         ClusterFunctions& product) {
  const int n = a.size();
  for (int i = 0; i < n; ++i) {
    for (int k = std::max(i - 1, 0); k < n; ++k) {
      const Pack factor = a(i, k);
      for (int j = std::max(k - 1, 0); j < n; ++j) product(i, j) += factor * b(k, j);
    }
  }
}

/// sum += factor f.
template <typename Factor>
SPRING_WORKBENCH_INLINE void add(const Factor& factor, const ClusterFunctions& f, ClusterFunctions& sum) {
  for (int i = 0; i < f.size(); ++i) {
    for (int j = std::max(i - 1, 0); j < f.size(); ++j) sum(i, j) += factor * f(i, j);
  }
}

/// f, times a factor.
SPRING_WORKBENCH_INLINE void set(double factor, const ClusterFunctions& f, ClusterFunctions& scaled) {
  for (int i = 0; i < f.size(); ++i) {
    for (int j = std::max(i - 1, 0); j < f.size(); ++j) scaled(i, j) = factor * f(i, j);
  }
}

SPRING_WORKBENCH_INLINE void add_unit_matrix(double factor, ClusterFunctions& sum) {
  for (int i = 0; i < sum.size(); ++i) sum(i, i) += factor;
}

/// Largest sum of a column's absolute values.
double norm(const ClusterFunctions& z) {
  Pack largest{};
  for (int j = 0; j < z.size(); ++j) {
    Pack column{};
    for (int i = 0; i < z.size(); ++i) column += z(i, j) > 0.0 ? z(i, j) : -z(i, j);
    largest = column > largest ? column : largest;
  }
  return math::largest(largest);
}

/// Weights at the moments `c` of the step, one in each lane.
SPRING_WORKBENCH_INLINE void add_weights(const Pack& c, const ClusterPhi& phi, ClusterFunctions& constant,
                                         ClusterWeights::PerNode& values) {
  add(c, phi[1], constant);
  Pack factor = c;  // ∫₀ᶜ e^{(c−s)z} sᵏ ds = k! c^{k+1} φ_{k+1}(c z)
  for (std::size_t k = 0; k < Collocation::count; ++k) {
    for (std::size_t j = 0; j < Collocation::count; ++j) {
      add(Pack(Collocation::power()[k][j] * factor), phi[k + 1], values[j]);
    }
    factor *= static_cast<double>(k + 1) * c;
  }
}

SPRING_WORKBENCH_WIDE void find_phi(int highest, const double* inverse_factorial, int doublings,
                                    const ClusterFunctions& z, ClusterPhi& phi) {
  const int n = z.size();
  const auto at = [&](int k) -> ClusterFunctions& { return phi[static_cast<std::size_t>(k)]; };
  for (int k = 0; k <= highest; ++k) at(k).set_zero(n);
  ClusterFunctions z2, z3, z4, next;
  for (ClusterFunctions* power : {&z2, &z3, &z4}) power->set_zero(n);
  add_product(z, z, z2);
  add_product(z2, z, z3);
  add_product(z2, z2, z4);
  std::array<double, 16> terms{inverse_factorial[highest]};  // zⁿ / (highest + n)!
  for (std::size_t k = 1; k < terms.size(); ++k) terms[k] = terms[k - 1] / (highest + static_cast<double>(k));
  for (std::size_t k = terms.size(); k > 0; k -= 4) {
    next.set_zero(n);
    if (k < terms.size()) add_product(at(highest), z4, next);
    add(terms[k - 3], z, next);
    add(terms[k - 2], z2, next);
    add(terms[k - 1], z3, next);
    add_unit_matrix(terms[k - 4], next);
    set(1.0, next, at(highest));
  }
  for (int k = highest; k > 0; --k) {
    add_product(at(k), z, at(k - 1));
    add_unit_matrix(inverse_factorial[k - 1], at(k - 1));
  }
  for (; doublings > 0; --doublings) {
    for (int l = highest; l >= 0; --l) {  // each from those below it, which are still those of z
      next.set_zero(n);
      add_product(at(0), at(l), next);
      for (int j = 1; j <= l; ++j) add(inverse_factorial[l - j], at(j), next);
      set(std::ldexp(1.0, -l), next, at(l));
    }
  }
}

SPRING_WORKBENCH_WIDE void find_weights(const ClusterPhi& at_nodes, const ClusterPhi& at_samples, ClusterWeights& w) {
  const Pack nodes = math::pack(Collocation::nodes);
  add_weights(nodes, at_nodes, w.constant, w.node);
  add_weights(math::pack(Collocation::samples), at_samples, w.sample_constant, w.sample);
  Pack factor = nodes;
  for (std::size_t m = 0; m < 2 * Collocation::count; ++m) {
    for (std::size_t k = 0; k < Collocation::count; ++k) {
      add(Pack(Collocation::defect_power()[k][m] * factor), at_nodes[m + 1], w.defect[k]);
    }
    factor *= static_cast<double>(m + 1) * nodes;
  }
}

}  // namespace

// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): see elements_
ClusterFunctions::ClusterFunctions(const ModalRates::Matrix& matrix, const Pack& factors)
    : size_(static_cast<int>(matrix.rows())) {
  for (int i = 0; i < size_; ++i) {
    for (int j = 0; j < size_; ++j) (*this)(i, j) = matrix(i, j) * factors;
  }
}

void find_phi_functions(int highest, const ClusterFunctions& z, ClusterPhi& phi) {
  std::array<double, 2 * Collocation::count + 1> inverse_factorial{1.0};
  for (std::size_t k = 1; k < inverse_factorial.size(); ++k) {
    inverse_factorial[k] = inverse_factorial[k - 1] / static_cast<double>(k);
  }
  int doublings = 0;
  if (const double size = norm(z); std::isfinite(size) && size >= 1.0) std::frexp(size, &doublings);
  ClusterFunctions scaled = z;
  set(std::ldexp(1.0, -doublings), z, scaled);
  find_phi(highest, inverse_factorial.data(), doublings, scaled, phi);
}

ClusterWeights cluster_weights(const ModalRates::Matrix& z) {
  ClusterPhi at_nodes, at_samples;
  find_phi_functions(2 * Collocation::count, {z, math::pack(Collocation::nodes)}, at_nodes);
  find_phi_functions(Collocation::count, {z, math::pack(Collocation::samples)}, at_samples);
  ClusterWeights w;
  w.constant.set_zero(at_nodes[0].size());
  w.sample_constant.set_zero(at_nodes[0].size());
  for (ClusterWeights::PerNode* of : {&w.node, &w.sample, &w.defect}) {
    for (ClusterFunctions& f : *of) f.set_zero(at_nodes[0].size());
  }
  find_weights(at_nodes, at_samples, w);
  return w;
}

}  // namespace spring_workbench::exponential
