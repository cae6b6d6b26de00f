#pragma once

#include <string>
#include <vector>

#include "benchmark/rod_case.h"

namespace spring_workbench::benchmark {

/// What the runs of a rod case are measured against.
struct RodReference {
  std::vector<RigidTransform> X_WO;     ///< at output_times(one)
  std::vector<RigidTransform> halfway;  ///< at those and half-way between them
  double largest_deflection = 0.0;      ///< of the centre of mass from where a rigid fork would hold it [m]
  double uncertainty = 0.0;             ///< estimated error of the positions [m]
};

/// The tolerance of references that have no closed form, relative, and absolute over what a strain is under the weight.
constexpr double kFineTolerance = 1e-12;

/// The Radau IIA method of order five at kFineTolerance on the equation of motion, from sample to sample of the hand,
/// where its acceleration jumps; its uncertainty is the distance from the same at ten times that. A recorded case: the
/// trajectory in its file, by another solver, at the outputs, and the former half-way; its uncertainty is the larger of
/// what the file says of itself and of the distance of the two at the outputs. Throws std::runtime_error when the
/// method gives up or the file has too few rows.
RodReference rod_reference(const RodCase& one, const std::string& shape);

/// The case with outputs half-way between its own, too.
RodCase with_halfway_outputs(RodCase one);

/// Every other pose.
std::vector<RigidTransform> every_other(const std::vector<RigidTransform>& poses);

/// The same by Radau IIA for every case.
std::vector<RigidTransform> fine_poses(const RodCase& one, const std::string& shape, double tolerance);

/// Largest distance of two trajectories in position [m] and angle [rad].
struct PoseDistance {
  double position = 0.0;
  double angle = 0.0;
};
PoseDistance largest_distance(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b);

}  // namespace spring_workbench::benchmark
