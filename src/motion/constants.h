#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::motion {

/// [s] between samples, half of the resolution of ROS time; a sample that follows sooner is ignored. Test:
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
/// Largest element of RᵀR − I of a matrix that counts as a rotation; others are refused. Test:
/// PoseTrack.RefusesWhatIsNotAPoseAndStaysAsItWas at 0.
constexpr double rotation_tolerance = 1e-6;
/// Number of samples over which the statistics of a stream are smoothed. Test: StreamMonitor.SaysRateJitterGapsAndAge
/// at 5.
constexpr std::size_t monitored_samples = 50;
/// [s] over which the present acceleration of a proxy is formed by differences. Larger: it belongs to a later time.
/// Test: Proxy.AtPresentIsMovedByTheHandAndByItsOffset at 1e-2.
constexpr double difference_time = 1e-4;
/// [m, rad] offset below which a proxy counts as returned. Test: none: no value tried makes one fail.
constexpr double no_offset = 1e-9;
/// [m, rad] distance from the goal at which a follower has arrived. Test:
/// PoseFollower.ComesToEveryGoalNeverFasterThanAHandAndNeverAway at 0.1.
constexpr double arrived = 1e-9;
/// [s] before the newest sample, from which the parabola is fitted. Longer: less noise, more lag; of 0.1 to 0.2 the
/// best for recorded hands. Test: PosePredictor.ForgetsWhatIsOlderThanItsWindow at 0.2.
constexpr double parabola_window = 0.14;
/// Smallest ratio of the determinant of the fit to the product of its diagonal; samples that are closer together
/// determine no parabola. Test: PosePredictor.FollowsLineAndParabolaExactly at 1.
constexpr double least_spread = 1e-6;
/// [s] between two samples of a head after which its motion restarts. Longer: the view flies on after a dropout. Test:
/// HeadMotion.RestsAfterADropoutAndAJumpOfTime at 10.
constexpr double head_dropout = 0.5;
/// [s] difference between clocks, from one reading to the next, that counts as a step; messages may be out of order by
/// as much. Less: late messages count as a clock that was set. Test: StreamClock.AMessageAloneMovesNothing at 2.
constexpr double clock_slip = 0.1;
/// Largest relative drift of a sender's clock. Less: drift counts as a step. Test: StreamClock.DriftIsFollowed at 0.
constexpr double clock_drift = 1e-3;
/// Number of messages that prove that a sender's clock was set. Test: StreamClock.AMessageAloneMovesNothing at 1.
constexpr std::size_t step_messages = 3;
/// [s] of stamps that these messages must cover. Shorter: messages that waited in a queue count as a step. Test:
/// StreamClock.WhatWaitedIsNoStep at 0.
constexpr double step_span = 0.05;
/// [s] time constant with which a slipped tool returns to the hand when the hand pulls less than the limit. Shorter:
/// the tool stays at its limit until the hand is back. Test: Slip.TheToolComesBackToTheHand at 10.
constexpr double slip_return_time = 0.1;
/// [m, rad] distance from the hand at which a slipped tool has returned. Test: Slip.TheToolComesBackToTheHand at 0.1.
constexpr double no_gap = 1e-9;

}  // namespace spring_workbench::motion
