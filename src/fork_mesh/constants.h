#pragma once

namespace spring_workbench::fork_mesh {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// of the curve's parameter, for its arc length; at compile time. Fewer: a wrong length. Test:
/// BezierCurve.HasTheRodsLengthAndItsStationsAreEvenlySpaced.
constexpr int bezier_pieces = 8;
/// of every curve: a full circle is 1e-6 of its length off between them. Fewer: farther off. Test:
/// ForkCurve.TheRodsIsTheRodBetweenItsStations.
constexpr int fork_curve_stations = 65;
/// [diameters] of the wire's centre: half of one, or the diameter is not the coil's. Test:
/// DeformedFork.TheCoilIsAsWideAsItsDiameterAndAFifthOfItThickAreTheDiscs.
constexpr double coil_radius = 0.5;
/// [diameters] thickness of the discs that hold the wire's ends. Test:
/// DeformedFork.TheCoilIsAsWideAsItsDiameterAndAFifthOfItThickAreTheDiscs.
constexpr double flange = 0.2;

/// Of the seam along the spring, for its drawing. Fewer: a spiral with corners. Test:
/// DeformedFork.TheSeamShowsTheTwist.
constexpr int seam_pieces = 40;
/// [m] of the tools that are no springs. Larger: clumsier. Test: ForkModel.EachToolHasALookOfItsOwn.
constexpr double rigid_diameter = 0.03;

}  // namespace spring_workbench::fork_mesh
