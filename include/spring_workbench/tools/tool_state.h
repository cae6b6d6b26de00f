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
  double mean = 0.0;
  double uncertainty = std::numeric_limits<double>::infinity();  ///< one standard deviation of the mean
};

/// State of the tool in a hand.
struct ToolState {
  bool present = false;           ///< whether a sample of this hand has arrived
  Tool tool = Tool::spring_fork;  ///< the tool in this hand
  std::string held_object;        ///< empty when nothing is held
  std::string touched;            ///< the body that the probe touches, "workbench" for the bench; otherwise empty
  rod::ShapeKind shape = rod::ShapeKind::linear;                                ///< shape model of the fork
  dynamics::IntegratorKind integrator = dynamics::IntegratorKind::exponential;  ///< of its equation of motion
  rod::ForkDofs dofs;                              ///< degrees of freedom of the fork that are switched on
  double length = 0.0;                             ///< rest length [m]
  rod::PerDof stiffness;                           ///< of stretching and bending [N/m] and of torsion [N·m/rad]
  rod::PerDof damping_ratio, damping_coefficient;  ///< the latter with the law `coefficients`: N·s/m, N·s/m, N·m·s/rad
  rod::DampingLaw damping_law = rod::DampingLaw::per_dof;  ///< the law in force
  rod::StrainVector strain;                          ///< all coordinates of the shape model; zero while nothing is held
  double stretch = 0.0;                              ///< extension along the rod [m]
  Eigen::Vector2d bend = Eigen::Vector2d::Zero();    ///< tip deflection along x and y of the handle [m]
  double torsion = 0.0;                              ///< twist angle [rad]
  RigidTransform X_WS = RigidTransform::Identity();  ///< pose of the stylus in world
  RigidTransform X_WH = RigidTransform::Identity();  ///< pose of the handle in world; that of the stylus unless
                                                     ///< calibration or a regrasp has moved it
  RigidTransform X_WH_proxy = RigidTransform::Identity();  ///< pose of the proxy handle in world (doc/model.md)
  RigidTransform X_WE = RigidTransform::Identity();        ///< pose of the tip in world
  Twist V_WE_W;                                            ///< twist of the tip, world axes
  Wrench tip_wrench_W;                                     ///< wrench on the object, at the tip, world axes [N, N·m]
  Wrench handle_wrench_H;                                  ///< wrench on the hand, at and in the handle frame [N, N·m]
  double elastic_energy = 0.0;                             ///< [J]
  double kinetic_energy = 0.0;                             ///< kinetic energy of the held object, in world [J]
  std::optional<double> error_bound;  ///< bound on the error of integration in position, since the grasp or the last
                                      ///< step without a bound [m]; none if the setting `error_bound` is off, and,
                                      ///< e.g., in contact (doc/model.md, "Error bound")
  double force_scale = 1.0;           ///< ratio of virtual to real force
  double weight = 0.0;                ///< reading as a scale: upward force on the object / g [vkg]
  double torque = 0.0;                ///< reading as a torque wrench: moment about the axis at the tip [N·m]
  Reading weight_average;             ///< [vkg]; left empty by `Simulation`, filled in by nodes
  Reading torque_average;             ///< [N·m]; left empty by `Simulation`, filled in by nodes
  double stretching_force = 0.0;  ///< force along the tool's axis at the handle, > 0 in tension [N] (paper, section 4)
  double bending_force = 0.0;     ///< force at the handle perpendicular to the tool's axis [N] (paper, section 4)
  double force_angle = 0.0;  ///< angle Φ between the tool's axis and the force on it, 0 … π [rad] (paper, section 4)
  double load = 0.0;         ///< load as a fraction of the scene's range of loads, 0 … 1
  bool clutch = false;       ///< whether the clutch is on: the hand moves without the tool
  double probe_damping = 0.0;                   ///< coefficient of the touching probe's own damper [N·s/m]
  double material_stiffness = 0.0;              ///< reading of the probe [N/m]; infinite: rigid; 0: no reading
  double material_stiffness_uncertainty = 0.0;  ///< one standard deviation [N/m]
};

}  // namespace spring_workbench::tools
