#include "spring_workbench/math/collocation.h"

namespace spring_workbench::math {
namespace {

constexpr auto& c = Collocation::nodes;

/// Coefficients of the Lagrange polynomials.
std::array<Collocation::Row, Collocation::count> lagrange() {
  std::array<Collocation::Row, Collocation::count> power{};
  for (std::size_t j = 0; j < Collocation::count; ++j) {
    std::array<double, Collocation::count + 1> p{1.0};
    std::size_t degree = 0;
    for (std::size_t m = 0; m < Collocation::count; ++m) {
      if (m == j) continue;
      ++degree;
      for (std::size_t k = degree + 1; k-- > 0;) p[k] = ((k > 0 ? p[k - 1] : 0.0) - c[m] * p[k]) / (c[j] - c[m]);
    }
    for (std::size_t k = 0; k < Collocation::count; ++k) power[k][j] = p[k];
  }
  return power;
}

}  // namespace

const std::array<Collocation::Row, Collocation::count>& Collocation::power() {
  static const auto coefficients = lagrange();
  return coefficients;
}

const Collocation::Row& Collocation::third_difference() { return power()[3]; }

const Collocation::Row& Collocation::second_difference() {
  // Of the cubic a c² + b c³ the mean of the two is its curvature in the middle, a + 3/2 b.
  static const Row mean = [] {
    Row row;
    for (std::size_t j = 0; j < count; ++j) row[j] = power()[2][j] + 1.5 * power()[3][j];
    return row;
  }();
  return mean;
}

std::array<Collocation::Row, Collocation::count> Collocation::continued(double ratio) {
  std::array<Row, count> rows{};
  for (std::size_t i = 0; i < count; ++i) {
    const double at = 1.0 + nodes[i] / ratio;
    for (std::size_t j = 0; j < count; ++j) {
      rows[i][j] = power()[0][j] + at * (power()[1][j] + at * (power()[2][j] + at * power()[3][j]));
    }
  }
  return rows;
}

}  // namespace spring_workbench::math
