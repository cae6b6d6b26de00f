#pragma once

#include <limits>
#include <optional>
#include <string>

#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/rod/shape_model.h"
#include "spring_workbench/tools/tool.h"

namespace spring_workbench::tools {

/// Average of an instrument's reading over a time window.
struct Reading {
  double mean = 0.0;                                             ///< mean, in the unit of the reading
  double uncertainty = std::numeric_limits<double>::infinity();  ///< one standard deviation of the mean
};

/// State of the tool in a hand, of whatever kind. Poses are in world W: stylus S, handle H, tip E.
struct ToolState {
  /// @name Tool
  /// @{
  bool present = false;           ///< whether a sample of this hand has arrived
  Tool tool = Tool::spring_fork;  ///< the tool in this hand
  std::string held_object;        ///< name of the held object; empty if nothing is held
  std::string touched;            ///< name of the body that the probe touches ("workbench": the bench), or empty
  bool clutch = false;            ///< whether the clutch is on: the hand moves without the tool
  double force_scale = 1.0;       ///< ratio of virtual to real force
  rod::ShapeKind shape = rod::ShapeKind::linear;                                ///< shape model of the fork
  dynamics::IntegratorKind integrator = dynamics::IntegratorKind::exponential;  ///< method for its equation of motion
  rod::ForkDofs dofs;               ///< degrees of freedom of the fork that are switched on
  double length = 0.0;              ///< rest length of the fork [m]
  rod::PerDof stiffness;            ///< stiffness of stretch and bend [N/m] and of torsion [N·m/rad]
  rod::PerDof damping_ratio;        ///< damping ratios, used by the laws `per_dof` and `modal`; 1 is critical
  rod::PerDof damping_coefficient;  ///< damping, used by the law `coefficients` [N·s/m, N·s/m, N·m·s/rad]
  rod::DampingLaw damping_law = rod::DampingLaw::per_dof;  ///< the damping law in force
  /// @}
  /// @name Deformation, poses and velocity
  /// @{
  rod::StrainVector strain;  ///< all strain coordinates, in the units of rod::ShapeModel; zero while nothing is held
  double stretch = 0.0;      ///< extension along the rod [m]
  Eigen::Vector2d bend = Eigen::Vector2d::Zero();  ///< tip deflection along x and y of the handle [m]
  double torsion = 0.0;                            ///< angle of torsion about the rod [rad]
  double load = 0.0;  ///< load as a fraction of the scene's heaviest weight, 0 … 1: colour of the fork
  RigidTransform X_WS = RigidTransform::Identity();  ///< pose of the stylus, without its motion under the clutch
  /// Pose of the handle. It differs from the pose of the stylus after a calibration or a regrasp.
  RigidTransform X_WH = RigidTransform::Identity();
  /// Pose of the proxy handle (doc/model.md), from which the fork acts. It stays behind X_WH if the object is stopped.
  RigidTransform X_WH_proxy = RigidTransform::Identity();
  RigidTransform X_WE = RigidTransform::Identity();  ///< pose of the tip
  Twist V_WE_W;                                      ///< velocity of the tip, world axes [m/s, rad/s]
  /// @}
  /// @name Forces, energies and errors
  /// @{
  Wrench tip_wrench_W;            ///< wrench on the object about the tip, world axes [N, N·m]
  Wrench handle_wrench_H;         ///< wrench on the hand about the handle's origin, handle's axes [N, N·m]
  double stretching_force = 0.0;  ///< axial force at the handle, > 0 in tension [N] (paper, section 4)
  double bending_force = 0.0;     ///< transverse force at the handle [N] (paper, section 4)
  double force_angle = 0.0;       ///< angle Φ between the tool's axis and the force on it, 0 … π [rad] (section 4)
  double elastic_energy = 0.0;    ///< energy stored in the tool [J]
  double kinetic_energy = 0.0;    ///< kinetic energy of the held object, in world [J]
  /// Bound of the error in position [m], empty in contact or if unknown; see simulation::AdvanceReport::error_bound.
  std::optional<double> error_bound;
  /// @}
  /// @name Instruments
  /// @{
  double weight = 0.0;              ///< reading as a scale: upward force on the object over g [vkg: virtual kg]
  double torque = 0.0;              ///< reading as a torque wrench: moment about the tool's axis at the tip [N·m]
  Reading weight_average;           ///< average of `weight` [vkg]; set by nodes, not by Simulation
  Reading torque_average;           ///< average of `torque` [N·m]; set by nodes, not by Simulation
  double probe_damping = 0.0;       ///< coefficient of the touching probe's own damper [N·s/m]
  double material_stiffness = 0.0;  ///< reading of the probe [N/m]; infinite: rigid; 0: no reading
  double material_stiffness_uncertainty = 0.0;  ///< one standard deviation [N/m]
  /// @}
};

}  // namespace spring_workbench::tools
