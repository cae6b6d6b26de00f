#pragma once

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::tools {

/// What a calibrated fork does under the weight of the object that it holds (paper, sections 3.1 and 4).
struct CalibrationGoal {
  double sag = 0.1;     ///< static extension, hanging, and static deflection of the tip, held level: part of the length
  double twist = 0.35;  ///< static twist under the weight at a lever of the object's radius of gyration [rad]
};

/// The acceleration [m/s²] that tells a weight from a mass: the scene's gravity, and without any the Earth's.
double weighing_gravity(double gravity);

/// Stiffness [N/m, N/m, N·m/rad] of a fork of shape model `shape` and `length` [m] for the body as it is grasped
/// (`body.X_OE`). Hanging from the upright fork it extends the fork by `goal.sag` of its length; held level, gravity
/// along −x of the handle, it deflects the tip by as much: both in the full nonlinear equilibrium. Then every
/// direction, twisting too, has near to the natural frequency `ω = sqrt(g / (sag · length))`, whatever the mass.
/// Without gravity as on Earth.
rod::PerDof calibrated_stiffness(rod::ShapeKind shape, double length, const dynamics::BodyInertia& body, double gravity,
                                 const CalibrationGoal& goal = {});

/// Stiffness [N/m] of the tool `spring` that the weight of `mass` [kg] extends by `goal.sag` of `length` [m]. Without
/// gravity as on Earth.
double calibrated_spring(double mass, double length, double gravity, const CalibrationGoal& goal = {});

/// Length [m] of a fork for a body, from its size: the one with which the weight at a lever of the body's radius of
/// gyration ρ twists the fork by `goal.twist`, `2 twist ρ / sag`. Limited to 1 mm … 100 m.
double calibrated_length(const dynamics::BodyInertia& body, const CalibrationGoal& goal = {});

}  // namespace spring_workbench::tools
