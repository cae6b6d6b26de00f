#pragma once

#include <cmath>
#include <random>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::assembly {

/// Standard normal random numbers (Box–Muller): the same sequence from a seed with every standard library.
class StandardNormal {
 public:
  explicit StandardNormal(unsigned seed) : random_(seed) {}

  double next() {
    constexpr double scale = 1.0 / 4294967296.0;
    const double a = (static_cast<double>(random_()) + 0.5) * scale;
    const double b = static_cast<double>(random_()) * scale;
    return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * M_PI * b);
  }
  Vector3d next_vector() {
    const double x = next(), y = next(), z = next();
    return {x, y, z};
  }

 private:
  std::mt19937 random_;
};

}  // namespace spring_workbench::assembly
