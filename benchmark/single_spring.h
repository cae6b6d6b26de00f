#pragma once

#include "benchmark/scenarios.h"

namespace spring_workbench::benchmark {

/// The one spring of scenes A and B as a force on the object's absolute coordinate.
struct SingleSpring {
  explicit SingleSpring(const Scenario& given)
      : scene(given),
        stiffness(given.stiffness[given.single_coordinate()]),
        damping(given.damping[given.single_coordinate()]),
        inertia(given.single_inertia()),
        gravity(given.kind == SceneKind::stretch ? given.gravity : 0.0) {}

  /// Force [N] or moment [N·m] on the object at height or twist `x` with the rate `v`.
  double force(const ScalarMotion& hand, double x, double v) const {
    return -stiffness * (x - hand.value) - damping * (v - hand.rate);
  }

  /// Acceleration of the object under the spring and gravity.
  double acceleration(const ScalarMotion& hand, double x, double v) const {
    return force(hand, x, v) / inertia - gravity;
  }

  Scenario scene;
  double stiffness;
  double damping;
  double inertia;
  double gravity;
};

}  // namespace spring_workbench::benchmark
