#pragma once

namespace spring_workbench::fork_mesh {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Number of segments of the curve for the quadrature of its arc length; at compile time. If fewer, the length is
/// wrong. Test: BezierCurve.HasTheRodsLengthAndItsStationsAreEvenlySpaced.
constexpr int bezier_segments = 8;
/// Number of stations of every curve; interpolation error of a full circle: 1e-6 of its length. If fewer, the error is
/// larger. Test: ForkCurve.TheRodsIsTheRodBetweenItsStations.
constexpr int fork_curve_stations = 65;
/// Radius of the coil to the centre of its wire [diameters]: half a diameter, by definition. Test:
/// DeformedFork.TheCoilIsAsWideAsItsDiameterAndAFifthOfItThickAreTheDiscs.
constexpr double coil_radius = 0.5;
/// Thickness of the discs that hold the ends of the wire [diameters]. Test:
/// DeformedFork.TheCoilIsAsWideAsItsDiameterAndAFifthOfItThickAreTheDiscs.
constexpr double flange = 0.2;

/// Number of segments of the seam that is drawn along the spring. If fewer, the spiral has corners. Test:
/// DeformedFork.TheSeamShowsTheTwist.
constexpr int seam_segments = 40;
/// Drawn diameter of rigid tools [m]. If larger, they look clumsy. Test: ForkModel.EachToolHasItsOwnAppearance.
constexpr double rigid_diameter = 0.03;

}  // namespace spring_workbench::fork_mesh
