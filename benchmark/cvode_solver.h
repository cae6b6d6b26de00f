#pragma once

#include <memory>
#include <vector>

#include "benchmark/held_body.h"

namespace spring_workbench::benchmark {

/// SUNDIALS CVODE (BDF, Newton, dense Jacobian by differences) on the scene in Lagrange's coordinates: (q, q̇) of the
/// bushing in scene C, deflection and rate in A and B.
class CvodeSolver {
 public:
  explicit CvodeSolver(const Scenario& scene);
  ~CvodeSolver();
  CvodeSolver(const CvodeSolver&) = delete;
  CvodeSolver& operator=(const CvodeSolver&) = delete;

  /// Outputs at output_times(scene), from the scene's start. Relative tolerance as given; absolute: the same times the
  /// static deflection's scale, and for rates that times the stiffest frequency's inverse time, at most 1.
  /// Throws std::runtime_error when CVODE gives up.
  std::vector<Vector3d> solve(double tolerance);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace spring_workbench::benchmark
