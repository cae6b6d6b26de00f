#pragma once

#include <random>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::test_support {

/// Seeded random numbers, vectors and poses.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  /// Each component in −size … size.
  Vector3d vector(double size) {
    const double x = number(-size, size), y = number(-size, size), z = number(-size, size);
    return {x, y, z};
  }
  Vector3d direction() {
    for (;;) {
      const Vector3d v = vector(1.0);
      if (v.norm() < 1.0 && v.norm() > 1e-3) return v.normalized();
    }
  }
  Matrix3d rotation() {
    const Vector3d axis = direction();
    return math::exp_so3(number(-3.1, 3.1) * axis);
  }
  RigidTransform pose(double size) {
    RigidTransform X = RigidTransform::Identity();
    X.linear() = rotation();
    X.translation() = vector(size);
    return X;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace spring_workbench::test_support
