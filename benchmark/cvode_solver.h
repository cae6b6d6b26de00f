#pragma once

#include <memory>
#include <vector>

#include "benchmark/cvode_problem.h"

namespace spring_workbench::benchmark {

/// SUNDIALS CVODE (BDF, Newton, dense Jacobian by differences) on a scene.
class CvodeSolver {
 public:
  CvodeSolver(const Scenario& scene, CvodeCoordinates coordinates);
  ~CvodeSolver();
  CvodeSolver(const CvodeSolver&) = delete;
  CvodeSolver& operator=(const CvodeSolver&) = delete;

  /// Outputs at output_times(scene), from the scene's start. Relative tolerance as given; absolute: the same times 1 in
  /// world coordinates, and times the static deflection's scale in the others.
  /// Throws std::runtime_error when CVODE gives up.
  std::vector<Vector3d> solve(double tolerance);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace spring_workbench::benchmark
