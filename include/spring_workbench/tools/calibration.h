#pragma once

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/settings.h"

namespace spring_workbench::tools {

/// Returns the acceleration [m/s²] that converts masses to weights: the scene's gravity or, if that is 0, the Earth's.
double weighing_gravity(double gravity);

/// Stiffness [N/m, N/m, N·m/rad] of a fork of shape model `shape` and `length` [m] for the body as it is grasped
/// (`body.X_OE`). Hanging from the upright fork it extends the fork by `goal.sag` of its length; held level, gravity
/// along −x of the handle, it deflects the tip by as much: both in the full nonlinear equilibrium. Every
/// direction, twisting included, then has about the natural frequency `ω = sqrt(g / (sag · length))`, whatever the
/// mass. If `gravity` is 0, the Earth's is used.
rod::PerDof calibrated_stiffness(rod::ShapeKind shape, double length, const dynamics::BodyInertia& body, double gravity,
                                 const ObjectGoal& goal = {});

/// Returns the stiffness [N/m] of the tool `spring` with which the weight of `mass` [kg] extends it by `sag` [m]. If
/// `gravity` is 0, the Earth's is used.
double calibrated_spring(double mass, double sag, double gravity);

/// Length [m] of a fork for a body, from its size and its weight (paper, section 3.1): `2 twist r / sag`, with r the
/// geometric mean of the body's radius of gyration and of that of a ball of water of the body's mass. The weight of a
/// body as dense as water, at a lever of its radius of gyration, then twists the fork by `goal.twist`. Limited to
/// 1 mm … 100 m.
double calibrated_length(const dynamics::BodyInertia& body, const ObjectGoal& goal = {});

/// The largest load of a scene: the mass [kg] of its heaviest movable body, and its radius of gyration [m] as the lever
/// of that weight. 1 kg at 50 mm where nothing has mass; `goal.heaviest` in place of the mass, if it is given.
struct WorldLoad {
  double mass = 1.0;
  double lever = 0.05;
};
WorldLoad world_load(const scene::Scene& scene, const WorldGoal& goal);

/// Stiffness [N/m, N/m, N·m/rad] of the one fork for all bodies of a world (paper, section 4), of `shape`, `length` and
/// `slope_stiffness` as in `fork`: hanging from the upright fork, `load.mass` extends it by `goal.stretch` of its
/// length; held level at its centre it deflects the tip by `goal.bend` of the length; held level at a lever of
/// `load.lever` from its centre it twists the fork by `goal.twist`: each in the full nonlinear equilibrium. Lighter
/// bodies deform it in proportion. If `gravity` is 0, the Earth's is used.
rod::PerDof world_stiffness(const rod::ForkSettings& fork, const WorldLoad& load, double gravity,
                            const WorldGoal& goal = {});

/// Sets the damping law of a calibrated fork to `modal` if the damping ratios of its degrees of freedom are equal.
void damp_calibrated(rod::ForkSettings& fork);

}  // namespace spring_workbench::tools
