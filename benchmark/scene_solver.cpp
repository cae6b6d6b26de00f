#include "benchmark/scene_solver.h"

namespace spring_workbench::benchmark {

SceneSolver::SceneSolver(const Scenario& scene, SceneCoordinates coordinates, const MakeSolver& make)
    : scene_(scene),
      problem_(make_scene_problem(scene, coordinates)),
      solver_(make(problem_->size(), [problem = problem_.get()](double t, const double* y, double* rate) {
        return problem->rates(t, y, rate);
      })) {}

std::vector<Vector3d> SceneSolver::solve(double tolerance) {
  std::vector<double> y(static_cast<std::size_t>(problem_->size())), scale = y;
  problem_->start(y.data());
  problem_->tolerance_scale(scale.data());
  solver_->begin(0.0, y, tolerance, scale);
  std::vector<Vector3d> outputs;
  for (const double end : output_times(scene_)) outputs.push_back(problem_->output(end, solver_->advance(end, kNever)));
  return outputs;
}

}  // namespace spring_workbench::benchmark
