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

std::vector<Vector3d> six_dof_outputs(const Scenario& scene, double tolerance) {
  if (!scene.samples) return SceneSolver(scene, SceneCoordinates::deflection, &make_radau).solve(tolerance);
  std::vector<Vector3d> outputs;
  for (const RigidTransform& X : fine_poses(rod_case(scene), "bushing", tolerance))
    outputs.push_back(scene_output(scene, X));
  return outputs;
}

std::vector<Vector3d> exact_outputs(const Scenario& scene) {
  if (scene.samples) return exact_outputs_on_samples(scene);
  std::vector<Vector3d> outputs;
  for (const double t : output_times(scene)) outputs.push_back(exact_output(scene, t));
  return outputs;
}

/// The outputs with the hand that was sampled, for a difference of which three digits matter.
std::vector<Vector3d> outputs_of_function(Scenario scene) {
  constexpr double tolerance = 1e-9;
  scene.samples.reset();
  if (scene.kind == SceneKind::six_dof) return six_dof_outputs(scene, tolerance);
  constexpr std::size_t finer = 40;
  scene.output_interval /= static_cast<double>(finer);
  const std::vector<Vector3d> fine = exact_outputs_on_samples(with_sampled_hand(scene));
  std::vector<Vector3d> outputs;
  for (std::size_t i = 0; i < fine.size(); i += finer) outputs.push_back(fine[i]);
  return outputs;
}

}  // namespace

ReferenceSolution reference_solution(const Scenario& scene) {
  constexpr double rounding = 1e-15;
  const bool is_exact = scene.kind != SceneKind::six_dof;
  ReferenceSolution reference =
      reference_from_outputs(scene, is_exact ? exact_outputs(scene) : six_dof_outputs(scene, kFineTolerance), rounding);
  if (!is_exact) reference.uncertainty = output_error(scene, reference, six_dof_outputs(scene, 10.0 * kFineTolerance));
  if (scene.samples) reference.hand_error = output_error(scene, reference, outputs_of_function(scene));
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
