#pragma once

#include <string>
#include <vector>

#include "benchmark/rod_case.h"

namespace spring_workbench::benchmark {

/// What the runs of a rod case are measured against.
struct RodReference {
  std::vector<RigidTransform> X_WO;  ///< at output_times(one)
  double largest_deflection = 0.0;   ///< of the centre of mass from where a rigid fork would hold it [m]
  double uncertainty = 0.0;          ///< estimated error of the positions [m]
};

/// SUNDIALS CVODE at 1e-12 on the equation of motion, begun anew at every sample of the hand, where its acceleration
/// jumps; its uncertainty is the distance from the same at 1e-11. A recorded case: the trajectory in its file, by
/// another solver. Throws std::runtime_error when CVODE gives up or the file has too few rows.
RodReference rod_reference(const RodCase& one, const std::string& shape);

/// The same by CVODE for every case.
std::vector<RigidTransform> cvode_poses(const RodCase& one, const std::string& shape, double tolerance);

/// The scale of a solver's absolute tolerance for the strain, roughly the static one, and its rate.
std::vector<double> tolerance_scale(const RodCase& one, const dynamics::HeldBody& body);

/// Largest distance of two trajectories in position [m] and angle [rad].
struct PoseDistance {
  double position = 0.0;
  double angle = 0.0;
};
PoseDistance largest_distance(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b);

}  // namespace spring_workbench::benchmark
