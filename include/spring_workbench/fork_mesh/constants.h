#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::fork_mesh {

/// Diameter of the coil as a fraction of the rest length, unless it is set (`fork_diameter`). Larger: stouter. Test:
/// ForkModel.EachToolHasALookOfItsOwn.
constexpr double usual_diameter = 0.16;
/// Factor of the opacity of an object that a tool's tip is in, so that the tip is seen there (paper, figure 11).
/// Larger: less of the tip is seen. Test: MarkersOfALift.WhatTheTipIsInIsTranslucent.
constexpr double pierced_opacity = 0.5;

}  // namespace spring_workbench::fork_mesh
