#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "benchmark/ode_solver.h"
#include "benchmark/scene_problem.h"

namespace spring_workbench::benchmark {

/// Makes a general solver for `size` equations.
using MakeSolver = std::function<std::unique_ptr<OdeSolver>(int size, OdeSolver::Rates rates)>;

/// A general solver applied to a scene.
class SceneSolver {
 public:
  SceneSolver(const Scenario& scene, SceneCoordinates coordinates, const MakeSolver& make);

  /// Outputs at output_times(scene), from the scene's start. `tolerance` is the relative tolerance; the absolute one is
  /// the same times 1 in world coordinates, or times the scale of the static deflection in the others. Throws
  /// std::runtime_error if the solver fails.
  std::vector<Vector3d> solve(double tolerance);

 private:
  Scenario scene_;
  std::unique_ptr<SceneProblem> problem_;
  std::unique_ptr<OdeSolver> solver_;
};

}  // namespace spring_workbench::benchmark
