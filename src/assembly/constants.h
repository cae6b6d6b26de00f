#pragma once

namespace spring_workbench::assembly {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// at one object. Fewer: more objects stay where they are. Test:
/// SimulatedOperator.GivesAnObjectUpAfterFourAttempts.
constexpr int most_attempts = 4;
/// of one reach. Fewer: objects are set down off their goal. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr int most_corrections = 6;
/// [m] under a carried object. Less: it runs against others. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr double clearance = 0.05;
/// part of the tolerance that a correction is made for. More: objects are set down off their goal. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr double good_enough = 0.3;
/// [m] an object this near above its target is set down. More: it falls. Test:
/// SimulatedOperator.AssemblesTheMiniWorldWithEveryFork.
constexpr double touching = 1.5e-3;
/// [m/s] an object slower than this is let go. More: it swings on. Test: none: corrections take longer than swings.
constexpr double steady_speed = 4e-3;
/// [s/bit] of a reach. Less: quicker. Test: SimulatedOperator.ReachesFollowFittsLaw.
constexpr double fitts_slope = 0.2;
/// [m] to which a reach aims. Less: slower. Test: SimulatedOperator.ReachesFollowFittsLaw.
constexpr double fitts_width = 0.01;
/// [m] a turn by an angle counts like a way of lever times it. More: turning takes longer. Test: none: in the shipped
/// scenes hands go farther than they turn.
constexpr double lever = 0.1;
/// [s] rounding of the samples' times. Test: SimulatedOperator.ActsOnWhatItSeesOneReactionLater.
constexpr double time_slack = 1e-9;
/// [m] a released object that falls further was dropped. Test: TaskMonitor.LettingGoInTheAirIsADrop.
constexpr double drop_height = 0.02;
/// [s] a contact that comes back within this time is the same one. Less: one bump counts often. Test:
/// TaskMonitor.RunningAgainstTheWallIsOneCollision.
constexpr double same_contact = 0.2;
/// z of a normal from which on the other one carries the object. More: setting down counts as a collision. Test:
/// TaskMonitor.CarryingTheBoxToItsTargetIsComplete.
constexpr double from_below = 0.7;

}  // namespace spring_workbench::assembly
