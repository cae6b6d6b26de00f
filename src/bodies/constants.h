#pragma once

// The constants of the module: unit, what changing one does, and the test that notices: "noticed by" was seen to fail
// with another value, "goes into" is by reading alone.

namespace spring_workbench::bodies {

/// [rad] of a free rotation in one piece of the midpoint rule. Larger: the axis of a tumbling body goes astray. Goes
/// into `Simulation.ThrownObjectFliesOnAParabolaAndKeepsItsAngularMomentum`.
constexpr double most_turn_per_piece = 0.1;
/// Pieces of a step, however fast a body spins. Goes into
/// `Simulation.ThrownObjectFliesOnAParabolaAndKeepsItsAngularMomentum`.
constexpr int most_substeps = 1000;

}  // namespace spring_workbench::bodies
