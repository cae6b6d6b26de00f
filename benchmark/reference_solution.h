#pragma once

#include <vector>

#include "benchmark/held_body.h"

namespace spring_workbench::benchmark {

/// What a run is measured against.
struct ReferenceSolution {
  std::vector<Vector3d> outputs;    ///< at output_times(scene): A and C centre of mass [m], B (0, 0, twist) [rad]
  double largest_deflection = 0.0;  ///< of the outputs from rigid_output(), after scene.settled_after [m or rad]
  double uncertainty = 0.0;         ///< estimated error of the outputs [m or rad]
  double hand_error = 0.0;          ///< of a sampled hand: how far the outputs are from those of the true hand, since
                                    ///< nobody knows how it moved between two samples [m or rad]
};

/// A sampled hand: SUNDIALS CVODE at 1e-12 on the library's equation of motion, begun anew at every sample, where the
/// hand's acceleration jumps. Otherwise scenes A and B: the exact solution. Scene C: SUNDIALS CVODE (BDF, dense) on
/// `bushing_acceleration`, rtol 1e-12, atol 1e-12 of the static deflection's scale; its uncertainty is the distance
/// from the same at 1e-11. Throws std::runtime_error when CVODE gives up.
ReferenceSolution reference_solution(const Scenario& scene);

/// A reference from given outputs: adds the largest deflection.
ReferenceSolution reference_from_outputs(const Scenario& scene, std::vector<Vector3d> outputs, double uncertainty);

/// Largest distance of `outputs` from the reference after scene.settled_after [m or rad].
double output_error(const Scenario& scene, const ReferenceSolution& reference, const std::vector<Vector3d>& outputs);

/// Static deflections under 1 g and 1 rad/s² or so, per coordinate of q: the scale of absolute tolerances.
Vector6d deflection_scale(const Scenario& scene);

}  // namespace spring_workbench::benchmark
