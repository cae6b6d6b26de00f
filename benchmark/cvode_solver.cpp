#include "benchmark/cvode_solver.h"

namespace spring_workbench::benchmark {

CvodeSolver::CvodeSolver(const Scenario& scene, CvodeCoordinates coordinates)
    : scene_(scene),
      problem_(make_cvode_problem(scene, coordinates)),
      integrator_(problem_->size(), [problem = problem_.get()](double t, const double* y, double* rate) {
        return problem->rates(t, y, rate);
      }) {}

std::vector<Vector3d> CvodeSolver::solve(double tolerance) {
  std::vector<double> y(static_cast<std::size_t>(problem_->size())), scale = y;
  problem_->start(y.data());
  problem_->tolerance_scale(scale.data());
  integrator_.begin(0.0, y, tolerance, scale);
  std::vector<Vector3d> outputs;
  for (const double end : output_times(scene_)) outputs.push_back(problem_->output(end, integrator_.advance(end)));
  return outputs;
}

}  // namespace spring_workbench::benchmark
