#pragma once

namespace spring_workbench::assembly {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// Number of attempts at one object. Fewer: more objects stay where they are. Test:
/// SimulatedOperator.GivesAnObjectUpAfterFourAttempts.
constexpr int most_attempts = 4;
/// Largest number of corrections of one reach. Fewer: objects are set down off their goal. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr int most_corrections = 6;
/// [m] of free height under a carried object. Less: it hits others. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr double clearance = 0.05;
/// Fraction of the tolerance that is left uncorrected. More: objects are set down off their goal. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr double good_enough = 0.3;
/// [m] height above its target at which an object is set down. More: it falls. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr double touching = 1.5e-3;
/// [m/s] below which an object is let go. More: it swings on. Test: none: corrections take longer than swings.
constexpr double steady_speed = 4e-3;
/// [s/bit] of a reach in Fitts' law. Less: quicker. Test: SimulatedOperator.ReachesFollowFittsLaw.
constexpr double fitts_slope = 0.2;
/// [m] width of the goal in Fitts' law. Less: slower. Test: SimulatedOperator.ReachesFollowFittsLaw.
constexpr double fitts_width = 0.01;
/// [m] displacement that counts as much as a rotation of one radian. More: turning takes longer. Test: none: in the
/// shipped scenes hands go farther than they turn.
constexpr double lever = 0.1;
/// [s] rounding of the times of samples. Test: SimulatedOperator.ActsOnWhatItSeesOneReactionLater.
constexpr double time_slack = 1e-9;
/// [m] a released object that falls further was dropped. Test: TaskMonitor.LettingGoInTheAirIsADrop.
constexpr double drop_height = 0.02;
/// [s] a contact that returns within this time counts as the same. Less: one bump counts several times. Test:
/// TaskMonitor.RunningAgainstTheWallIsOneCollision.
constexpr double same_contact = 0.2;
/// z component of a contact normal above which the other body carries the object. More: setting down counts as a
/// collision. Test: TaskMonitor.CarryingTheBoxToItsTargetIsComplete.
constexpr double from_below = 0.7;

}  // namespace spring_workbench::assembly
