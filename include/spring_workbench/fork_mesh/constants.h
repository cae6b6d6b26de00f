#pragma once

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::fork_mesh {

/// Default diameter of the coil as a fraction of the rest length (`fork_diameter`). If larger, it is thicker. Test:
/// ForkModel.EachToolHasItsOwnAppearance.
constexpr double default_diameter = 0.16;
/// Factor on the opacity of an object that contains a tool's tip, so that the tip stays visible (paper, figure 11).
/// If larger, the tip is less visible. Test: MarkersOfALift.TheObjectThatTheTipIsInIsTranslucent.
constexpr double pierced_opacity = 0.5;

}  // namespace spring_workbench::fork_mesh
