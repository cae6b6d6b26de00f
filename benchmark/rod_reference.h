#pragma once

#include <string>
#include <vector>

#include "benchmark/rod_case.h"

namespace spring_workbench::benchmark {

/// The reference against which runs of a rod case are measured.
struct RodReference {
  std::vector<RigidTransform> X_WO;     ///< at output_times(one)
  std::vector<RigidTransform> halfway;  ///< at these times and halfway between them
  double largest_deflection = 0.0;      ///< of the centre of mass, relative to a rigid fork [m]
  double uncertainty = 0.0;             ///< estimated error of the positions [m]
  /// How far the motion of the body is from that on the hand itself, since its samples do not say how it moves between
  /// them: of its farthest point, at the outputs and halfway between. 0 if not known [m].
  double hand_error = 0.0;
};

/// Tolerance of references without a closed form: relative, and absolute relative to the strain under the weight.
constexpr double kFineTolerance = 1e-12;

/// The Radau IIA method of order five at kFineTolerance on the equation of motion, from sample to sample of the hand,
/// where its acceleration jumps; its uncertainty is the distance from the solution at ten times that tolerance. For a
/// recorded case, the trajectory in its file, by another solver, is used at the outputs, and the Radau solution halfway
/// between; the uncertainty is the larger of the file's own and the distance between the two at the outputs. The error
/// left by the samples is the distance from the solution on `fine_hand`. Throws std::runtime_error if the method fails
/// or the file has too few rows.
RodReference rod_reference(const RodCase& one, const std::string& shape);

/// The case with additional outputs halfway between its own.
RodCase with_halfway_outputs(RodCase one);

/// Every other pose.
std::vector<RigidTransform> every_other(const std::vector<RigidTransform>& poses);

/// The Radau IIA solution of any case at this tolerance.
std::vector<RigidTransform> fine_poses(const RodCase& one, const std::string& shape, double tolerance);

/// Distance from the centre of mass to the farthest corner of the uniform box that has the case's inertia [m].
double farthest_point(const RodCase& one);

/// Largest distance of two trajectories in position [m] and angle [rad].
struct PoseDistance {
  double position = 0.0;
  double angle = 0.0;
};
PoseDistance largest_distance(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b);

}  // namespace spring_workbench::benchmark
