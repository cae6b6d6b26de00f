#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::bodies {

/// [rad] of a free rotation in one substep of the Runge–Kutta method. Larger: a tumbling body gains or loses energy.
/// Test: FreeRotation.KeepsItsEnergyAndIsOfOrderFour at 1.
constexpr double max_turn_per_substep = 0.1;
/// Substeps, however fast a body spins. Test: none: no value tried makes one fail.
constexpr int max_substeps = 1000;

}  // namespace spring_workbench::bodies
