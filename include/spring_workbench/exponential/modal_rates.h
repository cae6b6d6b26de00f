#pragma once

#include <algorithm>
#include <array>

#include "spring_workbench/exponential/general_complex.h"
#include "spring_workbench/math/pack.h"

namespace spring_workbench::exponential {

/// The matrix B of a linear part in its modes, ẋ = B x, which is block-diagonal: first pairs of modes, then single
/// ones, then clusters (RealModes).
struct ModalRates {
  static constexpr int max_modes = 12;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_modes, max_modes>;

  int pairs = 0;  ///< the first 2 `pairs` modes; a pair of the rate a + b j: ẋ₀ = a x₀ + b x₁, ẋ₁ = a x₁ + j² b x₀
  int singles = 0;  ///< modes after them: ẋ = rate x
  /// Rates: of each pair (twice), of each single mode, and the eigenvalues of each cluster's matrix [1/s].
  std::array<GeneralComplex, max_modes> of;
  Matrix clusters;  ///< of the remaining modes: the clusters' matrices, along the diagonal
  std::array<int, max_modes / 3> cluster_sizes{};  ///< each at least 3; 0: no further cluster

  int unclustered() const { return 2 * pairs + singles; }
  int count() const { return unclustered() + static_cast<int>(clusters.rows()); }
  /// Absolute value of the rate of mode `m`.
  double size(int m) const { return abs(of[static_cast<std::size_t>(m)]); }
  double fastest() const {
    double largest = 0.0;
    for (int m = 0; m < count(); ++m) largest = std::max(largest, size(m));
    return largest;
  }

  /// B x.
  template <int n>
  SPRING_WORKBENCH_INLINE Eigen::Matrix<double, n, 1> applied(const Eigen::Matrix<double, n, 1>& x) const {
    Eigen::Matrix<double, n, 1> rate;
    const int first = unclustered();
    for (int m = 0; m < first; ++m) {
      const GeneralComplex& z = of[static_cast<std::size_t>(m)];
      rate[m] = z.re * x[m] + (m % 2 == 0 ? 1.0 : z.square) * z.im * x[m ^ 1];
    }
    for (int m = first; m < n; ++m) rate[m] = clusters.row(m - first).dot(x.tail(n - first));
    return rate;
  }

  friend bool operator==(const ModalRates& a, const ModalRates& b) {
    return a.pairs == b.pairs && a.singles == b.singles && a.of == b.of && a.cluster_sizes == b.cluster_sizes &&
           a.clusters.rows() == b.clusters.rows() && a.clusters == b.clusters;
  }
  void archive(math::StateArchive& state) { state(pairs, singles, of, clusters, cluster_sizes); }
};

}  // namespace spring_workbench::exponential
