#include "spring_workbench/math/quadrature.h"

#include <cmath>

namespace spring_workbench::math {

template <int N>
GaussLegendre<N>::GaussLegendre() {
  // Legendre polynomial of degree n and its derivative, by the three-term recurrence.
  const auto legendre = [](int n, double x, double& derivative) {
    double p0 = 1.0, p1 = x;
    if (n == 0) {
      derivative = 0.0;
      return 1.0;
    }
    for (int k = 2; k <= n; ++k) {
      const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
      p0 = p1;
      p1 = p2;
    }
    derivative = n * (x * p1 - p0) / (x * x - 1.0);
    return p1;
  };
  for (int i = 0; i < N; ++i) {
    double x = -std::cos(M_PI * (i + 0.75) / (N + 0.5));
    double derivative = 1.0;
    for (int newton = 0; newton < 20; ++newton) x -= legendre(N, x, derivative) / derivative;
    legendre(N, x, derivative);
    nodes[i] = 0.5 * (1.0 + x);
    weights[i] = 1.0 / ((1.0 - x * x) * derivative * derivative);
  }
  // The interpolant through the nodes in Legendre polynomials, integrated: ∫ P_k = (P_{k+1} − P_{k−1}) / (2k + 1).
  for (int i = 0; i < N; ++i) {
    const double xi = 2.0 * nodes[i] - 1.0;
    for (int j = 0; j < N; ++j) {
      const double xj = 2.0 * nodes[j] - 1.0;
      double unused;
      double sum = 0.5 * (xi + 1.0);
      for (int k = 1; k < N; ++k) {
        const double integral = 0.5 * (legendre(k + 1, xi, unused) - legendre(k - 1, xi, unused)) / (2 * k + 1);
        sum += (2 * k + 1) * legendre(k, xj, unused) * integral;
      }
      cumulative(i, j) = weights[j] * sum;
    }
  }
}

template struct GaussLegendre<5>;
template struct GaussLegendre<6>;
template struct GaussLegendre<8>;

}  // namespace spring_workbench::math
