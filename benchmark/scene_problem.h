#pragma once

#include <memory>

#include "benchmark/held_body.h"

namespace spring_workbench::benchmark {

/// A scene as a system of first-order equations for a general solver.
class SceneProblem {
 public:
  virtual ~SceneProblem() = default;

  virtual int size() const = 0;

  /// Writes the state at t = 0 to `y`.
  virtual void start(double* y) const = 0;

  /// Writes the scale of the absolute tolerance of each entry to `scale`.
  virtual void tolerance_scale(double* scale) const = 0;

  /// Writes the rates to `rate`; returns false if the state is outside the domain of the equations.
  virtual bool rates(double t, const double* y, double* rate) const = 0;

  /// The output of the scene, as in RunResult.
  virtual Vector3d output(double t, const double* y) const = 0;
};

enum class SceneCoordinates {
  deflection,  ///< (q, q̇) of the bushing: tolerances act on the deflection
  world        ///< pose and velocity of the object in world: tolerances act on the position
};

std::unique_ptr<SceneProblem> make_scene_problem(const Scenario& scene, SceneCoordinates coordinates);

}  // namespace spring_workbench::benchmark
