#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::motion {

/// [s] between samples, half of what ROS time resolves; one that comes sooner is left out. Test:
/// PoseTrack.EqualAndBackwardStampsAreLeftOut at 0.
constexpr double shortest_interval = 0.5e-9;
/// [s]; a stamp beyond it is refused. Test: PoseTrack.RefusesWhatIsNotAPoseAndStaysAsItWas at 0.
constexpr double farthest_time = 1e12;
/// [m]; a coordinate beyond it is refused. Test: PoseTrack.RefusesWhatIsNotAPoseAndStaysAsItWas at 0.
constexpr double farthest_position = 1e9;
/// [N]; a component of an external wrench beyond it is refused. Test:
/// WrenchTrack.RefusesWhatNoSensorMeasuresAndStaysAsItWas.
constexpr double largest_force = 1e5;
/// [N·m]; likewise. Test: WrenchTrack.RefusesWhatNoSensorMeasuresAndStaysAsItWas.
constexpr double largest_moment = 1e5;
/// Of RᵀR − I; what is off by more is no rotation and refused. Test: PoseTrack.RefusesWhatIsNotAPoseAndStaysAsItWas at
/// 0.
constexpr double rotation_tolerance = 1e-6;
/// Over which the figures of a stream are smoothed. Test: StreamMonitor.SaysRateJitterGapsAndAge at 5.
constexpr std::size_t monitored_samples = 50;
/// [s] over which the velocity and the acceleration of a proxy at present are seen. Larger: they are those of a time
/// that is still to come. Test: Proxy.AtPresentIsMovedByTheHandAndByItsOffset at 1e-2.
constexpr double glance = 1e-4;
/// [m, rad]; the proxy has come back. Test: none: no value tried makes one fail.
constexpr double no_offset = 1e-9;
/// [m, rad]; a follower so near to its goal is there. Test:
/// PoseFollower.ComesToEveryGoalNeverFasterThanAHandAndNeverAway at 0.1.
constexpr double arrived = 1e-9;
/// [s] before the newest sample from which a parabola is fitted. Longer: less noise, more lag; of 0.1 to 0.2 the best
/// for recorded hands. Test: PosePredictor.ForgetsWhatIsOlderThanItsWindow at 0.2.
constexpr double parabola_window = 0.14;
/// Of the determinant of a fit to the product of its diagonal; samples closer together than that say no parabola. Test:
/// PosePredictor.FollowsLineAndParabolaExactly at 1.
constexpr double least_spread = 1e-6;
/// [s] between two samples of a head after which its motion is another one. Longer: the view flies on after a dropout.
/// Test: HeadMotion.RestsAfterADropoutAndAJumpOfTime at 10.
constexpr double head_dropout = 0.5;
/// [s] by which clocks may move against each other from look to look, and a message be out of order. Less: late
/// messages count as a clock that was set. Test: StreamClock.AMessageAloneMovesNothing at 2.
constexpr double clock_slip = 0.1;
/// Of time, by which a sender's clock may drift. Less: drift counts as a step. Test: StreamClock.DriftIsFollowed at 0.
constexpr double clock_drift = 1e-3;
/// Messages that show that a sender's clock was set. Test: StreamClock.AMessageAloneMovesNothing at 1.
constexpr std::size_t step_messages = 3;
/// [s] of stamps over which they must come evenly. Shorter: what waited counts as a step. Test:
/// StreamClock.WhatWaitedIsNoStep at 0.
constexpr double step_span = 0.05;
/// [s] on which a tool that has slipped comes back to the hand, where that pulls less than it can. Shorter: it stays at
/// its limit until the hand is back. Test: Slip.TheToolComesBackToTheHand at 10.
constexpr double slip_return_time = 0.1;
/// [m, rad]; a tool so near to the hand is there again. Test: Slip.TheToolComesBackToTheHand at 0.1.
constexpr double no_gap = 1e-9;

}  // namespace spring_workbench::motion
