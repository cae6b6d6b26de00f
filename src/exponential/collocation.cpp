#include "spring_workbench/exponential/collocation.h"

namespace spring_workbench::exponential {
namespace {

constexpr auto& c = Collocation::nodes;
constexpr auto& s = Collocation::samples;
constexpr std::size_t count = Collocation::count;

/// Coefficients of a polynomial of degree below `size`, times (x − zero) / scale.
template <std::size_t size>
void multiply(std::array<double, size>& p, double zero, double scale) {
  for (std::size_t k = size; k-- > 0;) p[k] = ((k > 0 ? p[k - 1] : 0.0) - zero * p[k]) / scale;
}

std::array<Collocation::Row, count> lagrange() {
  std::array<Collocation::Row, count> power{};
  for (std::size_t j = 0; j < count; ++j) {
    std::array<double, count> p{1.0};
    for (std::size_t m = 0; m < count; ++m) {
      if (m != j) multiply(p, c[m], c[j] - c[m]);
    }
    for (std::size_t k = 0; k < count; ++k) power[k][j] = p[k];
  }
  return power;
}

std::array<std::array<double, 2 * count>, count> defects() {
  std::array<std::array<double, 2 * count>, count> power{};
  for (std::size_t k = 0; k < count; ++k) {
    power[k][0] = 1.0;
    for (std::size_t m = 0; m < count; ++m) {
      multiply(power[k], c[m], s[k] - c[m]);
      if (m != k) multiply(power[k], s[m], s[k] - s[m]);
    }
  }
  return power;
}

}  // namespace

const std::array<Collocation::Row, count>& Collocation::power() {
  static const auto coefficients = lagrange();
  return coefficients;
}

Collocation::Row Collocation::interpolated(double at) {
  const std::array<Row, count>& coefficients = power();
  Row row{};
  for (std::size_t k = count; k-- > 0;) {
    for (std::size_t j = 0; j < count; ++j) row[j] = row[j] * at + coefficients[k][j];
  }
  return row;
}

const std::array<math::Pack, count>& Collocation::at_samples() {
  static const auto rows = [] {
    std::array<math::Pack, count> r{};
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t j = 0; j < count; ++j) r[j][k] = interpolated(s[k])[j];
    }
    return r;
  }();
  return rows;
}

const std::array<std::array<double, 2 * count>, count>& Collocation::defect_power() {
  static const auto coefficients = defects();
  return coefficients;
}

const Collocation::Row& Collocation::third_degree() {
  static const Row row = [] {
    Row values;
    for (std::size_t k = 0; k < count; ++k) {
      values[k] = 1.0;
      for (std::size_t m = 0; m < count; ++m) values[k] *= (s[k] - c[m]) * (m == k ? 1.0 : s[k] - s[m]);
    }
    return values;
  }();
  return row;
}

}  // namespace spring_workbench::exponential
