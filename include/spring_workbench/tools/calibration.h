#pragma once

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/settings.h"

namespace spring_workbench::tools {

/// Returns the acceleration [m/s²] that converts masses to weights: the scene's gravity or, if that is 0, the Earth's.
double weighing_gravity(double gravity);

/// Returns the stiffness [N/m, N/m, N·m/rad] of a fork of shape model `shape` and `length` [m] for the body as it is
/// grasped (`body.X_OE`). Hanging from the upright fork, the body extends it by `goal.sag` of its length; held level,
/// with gravity along −x of the handle, it deflects the tip by the same distance, both in the full nonlinear
/// equilibrium. The natural frequency in every direction, including twist, is then about `ω = sqrt(g / (sag ·
/// length))`, whatever the mass. If `gravity` is 0, the Earth's is used.
rod::PerDof calibrated_stiffness(rod::ShapeKind shape, double length, const dynamics::BodyInertia& body, double gravity,
                                 const ObjectGoal& goal = {});

/// Returns the stiffness [N/m] of the tool `spring` with which the weight of `mass` [kg] extends it by `sag` [m]. If
/// `gravity` is 0, the Earth's is used.
double calibrated_spring(double mass, double sag, double gravity);

/// Returns the length [m] of a fork for a body, from its size and weight (paper, section 3.1): `2 twist r / sag`, where
/// r is the geometric mean of the radii of gyration of the body and of a ball of water of the same mass. The weight of
/// a body with the density of water, at a lever arm equal to its radius of gyration, then twists the fork by
/// `goal.twist`. Limited to 1 mm … 100 m.
double calibrated_length(const dynamics::BodyInertia& body, const ObjectGoal& goal = {});

/// The largest load of a scene: the mass [kg] of its heaviest movable body, or `goal.heaviest` if that is given, and
/// the radius of gyration of that body [m] as the lever arm of its weight. 1 kg at 50 mm if no body has mass.
struct WorldLoad {
  double mass = 1.0;
  double lever = 0.05;
};
WorldLoad world_load(const scene::Scene& scene, const WorldGoal& goal);

/// Returns the stiffness [N/m, N/m, N·m/rad] of one fork for all bodies of a scene (paper, section 4), with `shape`,
/// `length` and `slope_stiffness` of `fork`. Hanging from the upright fork, `load.mass` extends it by `goal.stretch` of
/// its length; held level at its centre, it deflects the tip by `goal.bend` of the length; held level at a lever arm
/// `load.lever` from its centre, it twists the fork by `goal.twist`, each in the full nonlinear equilibrium. Lighter
/// bodies deform the fork proportionally less. If `gravity` is 0, the Earth's is used.
rod::PerDof world_stiffness(const rod::ForkSettings& fork, const WorldLoad& load, double gravity,
                            const WorldGoal& goal = {});

/// Sets the damping law of a calibrated fork to `modal` if the damping ratios of its degrees of freedom are equal.
void damp_calibrated(rod::ForkSettings& fork);

}  // namespace spring_workbench::tools
