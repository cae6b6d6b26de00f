#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::tools {

/// [m] of the tool `spring`, which has a direction then. Test: none: no value tried makes one fail.
constexpr double least_rest_length = 1e-4;
/// [m]; a shorter span of the tool `spring` has no direction. Test: none: no value tried makes one fail.
constexpr double no_length = 1e-12;
/// Of the fork's length: radius of gyration of a point mass. Larger: it is no point. Test:
/// Simulation.PointMassOnTheAxisDoesNotTwistAndOffItDoes at 0.1.
constexpr double point_mass_radius = 1e-2;
/// Of the fork's length; a point mass so near to the fork's axis cannot twist it. Test:
/// Simulation.PointMassOnTheAxisDoesNotTwistAndOffItDoes at 0.1.
constexpr double on_the_axis = 1e-3;
/// [s] on which the proxy comes back to the hand. Shorter: the object catches up faster. Test:
/// StopContact.AForkThatCannotFollowPressesAsItsRuleSaysAndHoldsNothingBack at 5.
constexpr double return_time = 0.05;
/// [s]; squared over the object's mass, how the proxy gives way at rest. Longer: what cannot follow presses less. Test:
/// StopContact.AForkThatCannotFollowPressesAsItsRuleSaysAndHoldsNothingBack.
constexpr double give_time = 5e-3;
/// [m/s], and of a turning times the fork's length, below which an object on a hand at rest stops (the paper's
/// threshold, section 3.3). Test: HeldAtRest.CostsNothing at 0.
constexpr double still_speed = 1e-7;
/// [m/s²], likewise. Test: none: no value tried makes one fail.
constexpr double still_acceleration = 1e-6;
/// [m] from the origin; a step of a hand farther away is rejected. Test: none: no value tried makes one fail.
constexpr double largest_distance = 1e6;
/// Of the generalised force that the springs exert after a regrasp: its largest error. Test:
/// TwoHands.HandoverMovesTheObjectLessThanAMillimetre at 0.
constexpr double exact_pull = 1e-12;
/// [rad/s] with which the object would swing on what is off in a fork that another tool leads. Smaller: it yields
/// under the object's weight. Larger: contact, solved to a micrometre, cannot say what two such forks are to carry.
/// Test: SharedLaw.WhatIsOffInBothForksSharesThePressOnTheBench at 1e4, 30.
constexpr double rigid_rate = 1e3;
/// [m] from the frame at rest to an object that nothing holds. Test: none: means nothing.
constexpr double frame_distance = 1.0;
/// [kg/m³]: objects of another density have a larger or smaller tool than their size asks. Larger: smaller tools. Test:
/// Calibration.LengthGrowsWithTheObjectAndWithItsWeight.
constexpr double density_of_water = 1000.0;

}  // namespace spring_workbench::tools
