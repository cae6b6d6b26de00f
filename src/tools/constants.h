#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::tools {

/// [m] rest length of the tool `spring`, so that it has a direction. Test: none: no value tried makes one fail.
constexpr double least_rest_length = 1e-4;
/// [m] length below which the tool `spring` has no direction. Test: none: no value tried makes one fail.
constexpr double no_length = 1e-12;
/// Radius of gyration of a point mass as a fraction of the fork's length. Larger: it is no point. Test:
/// Simulation.PointMassOnTheAxisDoesNotTwistAndOffItDoes at 0.1.
constexpr double point_mass_radius = 1e-2;
/// Fraction of the fork's length; a point mass that is closer to the axis cannot twist the fork. Test:
/// Simulation.PointMassOnTheAxisDoesNotTwistAndOffItDoes at 0.1.
constexpr double on_the_axis = 1e-3;
/// [s] time constant with which the proxy returns to the hand. Shorter: the object catches up faster. Test:
/// StopContact.AForkThatCannotFollowPressesAsItsRuleSaysAndHoldsNothingBack at 5.
constexpr double return_time = 0.05;
/// [s]; its square over the object's mass is the static compliance of the proxy. Longer: a tool that cannot follow
/// presses less. Test: StopContact.AForkThatCannotFollowPressesAsItsRuleSaysAndHoldsNothingBack.
constexpr double compliance_time = 5e-3;
/// [m/s], and times the fork's length for the rotation: an object on a hand at rest that is slower is stopped (the
/// paper's threshold, section 3.3). Test: HeldAtRest.CostsNothing at 0.
constexpr double still_speed = 1e-7;
/// [m/s²], likewise. Test: none: no value tried makes one fail.
constexpr double still_acceleration = 1e-6;
/// [m] from the origin; a step of a hand that is farther away is rejected. Test: none: no value tried makes one fail.
constexpr double largest_distance = 1e6;
/// Largest relative error of the generalised force that the springs exert after a regrasp. Test:
/// TwoHands.HandoverMovesTheObjectLessThanAMillimetre at 0.
constexpr double regrasp_tolerance = 1e-12;
/// [rad/s] at which the object would oscillate on the DOFs that are off in a fork that follows another tool. Smaller:
/// these DOFs yield under the object's weight. Larger: contact, solved to a micrometre, does not determine how two such
/// forks share a load. Test: SharedLaw.WhatIsOffInBothForksSharesThePressOnTheBench at 1e4, 30.
constexpr double rigid_rate = 1e3;
/// [m] from an object that no tool holds to the frame at rest that stands in for its tool. Test: none: means nothing.
constexpr double frame_distance = 1.0;
/// [kg/m³] density for which the size of a calibrated tool depends on the object's size alone. Larger: smaller tools.
/// Test: Calibration.LengthGrowsWithTheObjectAndWithItsWeight.
constexpr double density_of_water = 1000.0;

}  // namespace spring_workbench::tools
