#pragma once

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::tools {

/// Minimum rest length of the tool `spring` [m], so that it has a direction. Test: none: no value tried makes one fail.
constexpr double min_rest_length = 1e-4;
/// Length below which the tool `spring` has no direction [m]. Test: none: no value tried makes one fail.
constexpr double no_length = 1e-12;
/// Radius of gyration of a point mass as a fraction of the fork's length. If larger, it does not act like a point.
/// Test: Simulation.PointMassOnTheAxisDoesNotTwistAndOffItDoes at 0.1.
constexpr double point_mass_radius = 1e-2;
/// Fraction of the fork's length; a point mass that is closer to the axis cannot twist the fork. Test:
/// Simulation.PointMassOnTheAxisDoesNotTwistAndOffItDoes at 0.1.
constexpr double on_the_axis = 1e-3;
/// Time constant with which the proxy returns to the hand [s]. If shorter, the object catches up faster. Test:
/// StopContact.AForkThatCannotFollowPressesByItsRuleAndBlocksNothing at 5.
constexpr double return_time = 0.05;
/// Time [s] whose square over the object's mass is the static compliance of the proxy. If longer, a tool that cannot
/// follow presses less. Test: StopContact.AForkThatCannotFollowPressesByItsRuleAndBlocksNothing.
constexpr double compliance_time = 5e-3;
/// Speed [m/s], for rotation divided by the fork's length, below which an object on a hand at rest is stopped (the
/// paper's threshold, section 3.3). Test: HeldAtRest.CostsNothing at 0.
constexpr double still_speed = 1e-7;
/// The same for acceleration [m/s²]. Test: none: no value tried makes one fail.
constexpr double still_acceleration = 1e-6;
/// Distance from the origin beyond which a step is rejected [m]. Test: none: no value tried makes one fail.
constexpr double largest_distance = 1e6;
/// Natural frequency of the object on the stiff springs that replace the DOFs that are off in a follower fork [rad/s].
/// If smaller, these DOFs yield under the object's weight. If larger, contact, which is solved to a micrometre, does
/// not determine how two such forks share a load. Test: SharedLaw.WhatIsOffInBothForksSharesThePressOnTheBench at 1e4,
/// 30.
constexpr double rigid_rate = 1e3;
/// Distance from an object that no tool holds to the resting frame that replaces its tool [m]. Test: none: it has no
/// effect.
constexpr double frame_distance = 1.0;
/// Density for which the size of a calibrated tool depends on the object's size alone [kg/m³]. If larger, tools are
/// smaller. Test: Calibration.LengthGrowsWithTheObjectAndWithItsWeight.
constexpr double density_of_water = 1000.0;

}  // namespace spring_workbench::tools
