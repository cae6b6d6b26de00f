#pragma once

namespace spring_workbench::fork_mesh {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// Segments of the curve's parameter over which its arc length is integrated; at compile time. Fewer: a wrong length.
/// Test: BezierCurve.HasTheRodsLengthAndItsStationsAreEvenlySpaced.
constexpr int bezier_segments = 8;
/// Stations of every curve; between them a full circle is off by 1e-6 of its length. Fewer: farther off. Test:
/// ForkCurve.TheRodsIsTheRodBetweenItsStations.
constexpr int fork_curve_stations = 65;
/// [diameters] radius of the coil to the centre of its wire: half a diameter, by definition. Test:
/// DeformedFork.TheCoilIsAsWideAsItsDiameterAndAFifthOfItThickAreTheDiscs.
constexpr double coil_radius = 0.5;
/// [diameters] thickness of the discs that hold the ends of the wire. Test:
/// DeformedFork.TheCoilIsAsWideAsItsDiameterAndAFifthOfItThickAreTheDiscs.
constexpr double flange = 0.2;

/// Segments of the seam that is drawn along the spring. Fewer: a spiral with corners. Test:
/// DeformedFork.TheSeamShowsTheTwist.
constexpr int seam_segments = 40;
/// [m] diameter of the tools that are no springs. Larger: clumsier. Test: ForkModel.EachToolHasALookOfItsOwn.
constexpr double rigid_diameter = 0.03;

}  // namespace spring_workbench::fork_mesh
