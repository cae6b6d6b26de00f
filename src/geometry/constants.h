#pragma once

// The constants of the module: unit, what changing one does, and the test that notices: "noticed by" was seen to fail
// with another value, "goes into" is by reading alone.

namespace spring_workbench::geometry {

/// [m] by which two edges have to be further apart than two faces to be the contact: those of flush faces are as far.
/// Larger: crossed edges are taken for faces. Goes into `RigidWorld.StackOfTenStandsAndSleeps`.
constexpr double edges_by = 1e-5;
/// Of the faces' gap, likewise. Goes into `RigidWorld.StackOfTenStandsAndSleeps`.
constexpr double edges_by_share = 0.05;
/// [m] by which a contact is deeper than the four that are kept, to take the place of one. Goes into
/// `RigidWorld.StackOfTenStandsAndSleeps`.
constexpr double stands_out = 1e-6;

}  // namespace spring_workbench::geometry
