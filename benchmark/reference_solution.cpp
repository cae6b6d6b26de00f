#include "benchmark/reference_solution.h"

#include <algorithm>
#include <cmath>

#include "benchmark/exact_oscillator.h"
#include "benchmark/rod_reference.h"
#include "benchmark/scene_solver.h"

namespace spring_workbench::benchmark {

Vector6d deflection_scale(const Scenario& scene) {
  const double load = scene.mass * scene.gravity;
  const double moment = scene.inertia.maxCoeff() + load * scene.p_EO.norm();
  Vector6d scale = Vector6d::Ones();
  for (int i = 0; i < 6; ++i) {
    if (scene.stiffness[i] > 0.0) scale[i] = (i < 3 ? load : moment) / scene.stiffness[i];
  }
  return scale.cwiseMin(1.0);
}

ReferenceSolution reference_from_outputs(const Scenario& scene, std::vector<Vector3d> outputs, double uncertainty) {
  ReferenceSolution reference;
  const std::vector<double> times = output_times(scene);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < scene.settled_after) continue;
    const double deflection = (outputs[i] - rigid_output(scene, times[i])).norm();
    reference.largest_deflection = std::max(reference.largest_deflection, deflection);
  }
  reference.outputs = std::move(outputs);
  reference.uncertainty = uncertainty;
  return reference;
}

namespace {

/// Reference from `outputs(tolerance)`; its uncertainty is the distance from the outputs at ten times the tolerance.
template <typename Outputs>
ReferenceSolution reference_by_tolerance(const Scenario& scene, Outputs&& outputs) {
  ReferenceSolution reference = reference_from_outputs(scene, outputs(kFineTolerance), 0.0);
  reference.uncertainty = output_error(scene, reference, outputs(10.0 * kFineTolerance));
  return reference;
}

ReferenceSolution six_dof_reference(const Scenario& scene) {
  if (scene.samples) {
    const RodCase one = rod_case(scene);
    return reference_by_tolerance(scene, [&](double tolerance) {
      std::vector<Vector3d> outputs;
      for (const RigidTransform& X : fine_poses(one, "bushing", tolerance)) outputs.push_back(scene_output(scene, X));
      return outputs;
    });
  }
  SceneSolver solver(scene, SceneCoordinates::deflection, &make_radau);
  return reference_by_tolerance(scene, [&](double tolerance) { return solver.solve(tolerance); });
}

ReferenceSolution single_reference(const Scenario& scene) {
  constexpr double rounding = 1e-15;
  if (scene.samples) return reference_from_outputs(scene, exact_outputs_on_samples(scene), rounding);
  std::vector<Vector3d> outputs;
  for (const double t : output_times(scene)) outputs.push_back(exact_output(scene, t));
  return reference_from_outputs(scene, std::move(outputs), rounding);
}

}  // namespace

ReferenceSolution reference_solution(const Scenario& scene) {
  ReferenceSolution reference = scene.kind == SceneKind::six_dof ? six_dof_reference(scene) : single_reference(scene);
  if (scene.samples) {
    Scenario known = scene;
    known.samples.reset();
    reference.hand_error = output_error(scene, reference, reference_solution(known).outputs);
  }
  return reference;
}

double output_error(const Scenario& scene, const ReferenceSolution& reference, const std::vector<Vector3d>& outputs) {
  double error = 0.0;
  const std::vector<double> times = output_times(scene);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] >= scene.settled_after) error = std::max(error, (outputs[i] - reference.outputs[i]).norm());
  }
  return error;
}

}  // namespace spring_workbench::benchmark
