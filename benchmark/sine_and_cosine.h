#pragma once

#include <cmath>

#include "spring_workbench/math/pack.h"

namespace spring_workbench::benchmark {

template <typename S>
struct SineAndCosine {
  S sine, cosine;
};

inline SineAndCosine<double> sine_and_cosine(double x) { return {std::sin(x), std::cos(x)}; }

/// Of four angles [rad] at once, each less than 10⁵ in size: to the rounding of a double.
SPRING_WORKBENCH_INLINE SineAndCosine<math::Pack> sine_and_cosine(const math::Pack& x) {
  using Integers = long long __attribute__((vector_size(sizeof(math::Pack))));
  // Added to a number, this leaves its nearest integer in the lowest bits.
  constexpr double to_integer = 6755399441055744.0;  // 1.5 · 2⁵²
  // π/2 in two pieces, of which the first has 33 bits: its multiples are exact.
  constexpr double high = 1.57079632673412561417, low = 6.07710050650619224932e-11;
  const math::Pack shifted = x * (1.0 / (high + low)) + to_integer;
  const Integers quarters = (Integers)shifted;
  const math::Pack count = shifted - to_integer;
  const math::Pack r = (x - count * high) - count * low, z = r * r;
  // Taylor's series in [−π/4, π/4].
  math::Pack s = z * (-1.0 / 1307674368000.0) + 1.0 / 6227020800.0;
  s = z * s - 1.0 / 39916800.0;
  s = z * s + 1.0 / 362880.0;
  s = z * s - 1.0 / 5040.0;
  s = z * s + 1.0 / 120.0;
  s = z * s - 1.0 / 6.0;
  s = r + r * (z * s);
  math::Pack c = z * (1.0 / 20922789888000.0) - 1.0 / 87178291200.0;
  c = z * c + 1.0 / 479001600.0;
  c = z * c - 1.0 / 3628800.0;
  c = z * c + 1.0 / 40320.0;
  c = z * c - 1.0 / 720.0;
  c = z * c + 1.0 / 24.0;
  c = z * c - 0.5;
  c = 1.0 + z * c;
  const Integers swapped = (quarters & 1) != 0;
  const Integers sine = swapped ? (Integers)c : (Integers)s, cosine = swapped ? (Integers)s : (Integers)c;
  return {(math::Pack)(sine ^ ((quarters & 2) << 62)), (math::Pack)(cosine ^ (((quarters + 1) & 2) << 62))};
}

}  // namespace spring_workbench::benchmark
