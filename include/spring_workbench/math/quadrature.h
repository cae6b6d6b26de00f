#pragma once

#include <Eigen/Core>

namespace spring_workbench::math {

/// Gauss–Legendre quadrature on [0, 1] with `N` nodes: exact for polynomials of degree 2 N − 1.
template <int N>
struct GaussLegendre {
  Eigen::Matrix<double, N, 1> nodes;
  Eigen::Matrix<double, N, 1> weights;
  /// `∫₀^{nodes[i]} f ds = Σ_j cumulative(i, j) f(nodes[j])`, exact for polynomials of degree N − 1.
  Eigen::Matrix<double, N, N> cumulative;

  GaussLegendre();
};

extern template struct GaussLegendre<5>;
extern template struct GaussLegendre<6>;
extern template struct GaussLegendre<8>;

}  // namespace spring_workbench::math
