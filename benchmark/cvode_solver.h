#pragma once

#include <memory>
#include <vector>

#include "benchmark/cvode_integrator.h"
#include "benchmark/cvode_problem.h"

namespace spring_workbench::benchmark {

/// SUNDIALS CVODE on a scene.
class CvodeSolver {
 public:
  CvodeSolver(const Scenario& scene, CvodeCoordinates coordinates);

  /// Outputs at output_times(scene), from the scene's start. Relative tolerance as given; absolute: the same times 1 in
  /// world coordinates, and times the static deflection's scale in the others.
  /// Throws std::runtime_error when CVODE gives up.
  std::vector<Vector3d> solve(double tolerance);

 private:
  Scenario scene_;
  std::unique_ptr<CvodeProblem> problem_;
  CvodeIntegrator integrator_;
};

}  // namespace spring_workbench::benchmark
