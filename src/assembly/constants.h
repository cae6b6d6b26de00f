#pragma once

namespace spring_workbench::assembly {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Maximum number of attempts to place one object. If smaller, more objects are left unplaced. Test:
/// SimulatedOperator.GivesUpAnObjectAfterFourAttempts.
constexpr int max_attempts = 4;
/// Maximum number of corrections of one reach. If smaller, objects are set down off their goal. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr int max_corrections = 6;
/// Clearance below a carried object [m]. If smaller, the object hits others. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr double clearance = 0.05;
/// Fraction of the tolerance that is left uncorrected. If larger, objects are set down off their goal. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr double good_enough = 0.3;
/// Height above its target at which an object is set down [m]. If larger, the object falls. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr double touching = 1.5e-3;
/// Speed below which an object is released [m/s]. If larger, it is released while it swings. Test: none: corrections
/// take longer than swings.
constexpr double steady_speed = 4e-3;
/// Slope of Fitts' law [s/bit]. If smaller, reaches are faster. Test: SimulatedOperator.ReachesFollowFittsLaw.
constexpr double fitts_slope = 0.2;
/// Width of the goal in Fitts' law [m]. If smaller, reaches are slower. Test: SimulatedOperator.ReachesFollowFittsLaw.
constexpr double fitts_width = 0.01;
/// Displacement equivalent to a rotation of one radian [m]. If larger, turning takes longer. Test: none: in the shipped
/// scenes translation always dominates.
constexpr double lever = 0.1;
/// Tolerance for rounding of sample times [s]. Test: SimulatedOperator.ActsOnWhatItPerceivedOneReactionTimeAgo.
constexpr double time_slack = 1e-9;
/// Height of fall above which a released object counts as dropped [m]. Test: TaskMonitor.LettingGoInTheAirIsADrop.
constexpr double drop_height = 0.02;
/// Time within which a contact that returns counts as the same [s]. If smaller, one bump counts several times. Test:
/// TaskMonitor.RunningAgainstTheWallIsOneCollision.
constexpr double same_contact = 0.2;
/// z component of a contact normal above which the other body carries the object. If larger, setting down counts as a
/// collision. Test: TaskMonitor.CarryingTheBoxToItsTargetIsComplete.
constexpr double from_below = 0.7;

}  // namespace spring_workbench::assembly
