#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "benchmark/ode_solver.h"
#include "benchmark/scene_problem.h"

namespace spring_workbench::benchmark {

/// Makes a general solver of so many equations.
using MakeSolver = std::function<std::unique_ptr<OdeSolver>(int size, OdeSolver::Rates rates)>;

/// A general solver on a scene.
class SceneSolver {
 public:
  SceneSolver(const Scenario& scene, SceneCoordinates coordinates, const MakeSolver& make);

  /// Outputs at output_times(scene), from the scene's start. Relative tolerance as given; absolute: the same times 1 in
  /// world coordinates, and times the static deflection's scale in the others.
  /// Throws std::runtime_error when the solver gives up.
  std::vector<Vector3d> solve(double tolerance);

 private:
  Scenario scene_;
  std::unique_ptr<SceneProblem> problem_;
  std::unique_ptr<OdeSolver> solver_;
};

}  // namespace spring_workbench::benchmark
