#pragma once

#include "spring_workbench/bodies/stepped_body.h"

namespace spring_workbench::bodies {

/// What one tool does to a rigid body over a step, linear about where the body is: along each column of `directions` (a
/// wrench at the object's centre, world axes) it exerts f, and `directionsᵀ · displacement = relaxed − compliance · f`,
/// the displacement [m; rad] being the body's over the step.
struct Coupling {
  using Directions = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

  Directions directions;
  Vector relaxed;            ///< displacement with which the tool exerts nothing
  Matrix compliance;         ///< symmetric, ≥ 0
  bool pushes_only = false;  ///< f ≥ 0: a tool that leans on the object and cannot pull
};

/// A tool that can share an object with others: seen from the object, springs and dampers without mass.
class CoupledTool {
 public:
  virtual ~CoupledTool() = default;

  /// Over the next `h` [s], with the object at its present pose `X_WO`. `mobility`: of the object alone (6 × 6).
  virtual Coupling coupling(double h, const RigidTransform& X_WO, const Matrix6d& mobility) const = 0;
  /// `h` [s] have passed, the object is there, and the tool did `pull_W` to it (at its centre, world axes).
  virtual void follow(double h, const motion::MotionState& object, const Wrench& pull_W) = 0;
  /// As for SteppedBody.
  virtual void save(TrialStart& start) const = 0;
  virtual void restore(const TrialStart& start) = 0;
};

}  // namespace spring_workbench::bodies
