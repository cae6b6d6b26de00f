#pragma once

#include <vector>

#include "benchmark/held_body.h"

namespace spring_workbench::benchmark {

/// The reference against which a run is measured.
struct ReferenceSolution {
  std::vector<Vector3d> outputs;  ///< at output_times(scene): A and C centre of mass [m], B (0, 0, twist) [rad]
  double largest_deflection =
      0.0;  ///< largest distance of the outputs from rigid_output(), after scene.settled_after [m or rad]
  double uncertainty = 0.0;  ///< estimated error of the outputs [m or rad]
  double hand_error = 0.0;   ///< of a sampled hand: how far the outputs are from those of the true hand, since
                             ///< nobody knows how it moved between two samples [m or rad]
};

/// Scenes A and B: the exact solution, segment by segment on a sampled hand. Scene C: the Radau IIA method of order
/// five at kFineTolerance, on `bushing_acceleration` if the hand is a function of time, or on the library's equation of
/// motion from sample to sample if it is sampled. Its uncertainty is the distance from the solution at ten times the
/// tolerance. Throws std::runtime_error if the method fails.
ReferenceSolution reference_solution(const Scenario& scene);

/// Makes a reference from given outputs and computes the largest deflection.
ReferenceSolution reference_from_outputs(const Scenario& scene, std::vector<Vector3d> outputs, double uncertainty);

/// Largest distance of `outputs` from the reference after scene.settled_after [m or rad].
double output_error(const Scenario& scene, const ReferenceSolution& reference, const std::vector<Vector3d>& outputs);

/// Approximate static deflections under 1 g and 1 rad/s², per coordinate of q: the scale of absolute tolerances.
Vector6d deflection_scale(const Scenario& scene);

}  // namespace spring_workbench::benchmark
