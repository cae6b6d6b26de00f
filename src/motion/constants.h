#pragma once

#include <cstddef>

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::motion {

/// Minimum interval between samples [s], half of the resolution of ROS time; a sample after a shorter one is ignored.
/// Test: PoseTrack.EqualAndBackwardStampsAreIgnored at 0.
constexpr double shortest_interval = 0.5e-9;
/// Largest stamp that is accepted [s]. Test: PoseTrack.RefusesInvalidPosesAndIsUnchanged at 0.
constexpr double farthest_time = 1e12;
/// Largest coordinate that is accepted [m]. Test: PoseTrack.RefusesInvalidPosesAndIsUnchanged at 0.
constexpr double farthest_position = 1e9;
/// Largest component of the force of an external wrench that is accepted [N]. Test:
/// WrenchTrack.RefusesImplausibleWrenchesAndIsUnchanged.
constexpr double largest_force = 1e5;
/// The same for the moment [N·m]. Test: WrenchTrack.RefusesImplausibleWrenchesAndIsUnchanged.
constexpr double largest_moment = 1e5;
/// Largest element of RᵀR − I of a matrix that counts as a rotation; others are refused. Test:
/// PoseTrack.RefusesInvalidPosesAndIsUnchanged at 0.
constexpr double rotation_tolerance = 1e-6;
/// Number of samples over which the statistics of a stream are smoothed. Test:
/// StreamMonitor.ReportsRateJitterGapsAndAge at 5.
constexpr std::size_t monitored_samples = 50;
/// Step of the finite difference for the current acceleration of a proxy [s]. If larger, the acceleration is that of a
/// later time. Test: Proxy.AtPresentIsMovedByTheHandAndByItsOffset at 1e-2.
constexpr double difference_time = 1e-4;
/// Offset below which a proxy counts as returned [m, rad]. Test: none: no value tried makes one fail.
constexpr double no_offset = 1e-9;
/// Distance from the goal at which a follower has arrived [m, rad]. Test:
/// PoseFollower.ReachesEveryGoalWithoutOvershootAndNeverFasterThanAHand at 0.1.
constexpr double arrived = 1e-9;
/// Time in which the weight of a sample in the fastest fitted parabola decays [s]; in each further one it is twice as
/// long. If longer, there is less noise but more lag in fast motions. Test: PosePredictor.IsGoodWithAndWithoutNoise at
/// 0.1.
constexpr double shortest_fit = 0.01;
/// The same in intervals between samples, at least. If less, the samples of a slow stream have weights too small to
/// determine a parabola; if more, it is followed with more lag. Test: PosePredictor.FollowsASlowStream at 0.
constexpr double least_intervals = 0.5;
/// Age in multiples of that time beyond which a sample is not fitted. If larger, fits take longer, for samples without
/// weight. Test: PosePredictor.ForgetsWhatIsOlderThanItsWindow at 12.
constexpr double forgotten = 6.0;
/// Least time between two samples that are fitted [s], except the newest one. If shorter, fits of fast streams take
/// longer; if longer, they are more noisy. Test: PosePredictor.FitsSkipSamplesOfAFastStream at 0.
constexpr double least_spacing = 0.005;
/// Time in which the weight of an error of the models decays [s]. If shorter, the weights of the models are noisy; if
/// longer, they follow changes of the motion more slowly. Test: PosePredictor.IsGoodAgainSoonAfterAShake at 10.
constexpr double error_memory = 1.0;
/// How far ahead the models are compared with the samples that came later [s]. Test:
/// PosePredictor.IsGoodWithAndWithoutNoise at 0.3.
constexpr double compared_ahead = 0.02;
/// Variance that is added to that of each model's errors, relative to it. If less, the weights of models that have made
/// similar errors are large and opposite; if more, a worse model keeps more weight. Test:
/// PosePredictor.IsGoodSoonAfterARestart at 0.
constexpr double shrinkage = 0.1;
/// Error of the models that counts as none [m, rad]. If larger, all have the same weight in slow motions. Test:
/// PosePredictor.FollowsLineAndParabolaExactly at 0.01.
constexpr double no_error = 1e-6;
/// Time between two samples of a head after which its motion restarts [s]. If longer, the view keeps moving after a
/// dropout. Test: HeadMotion.RestsAfterADropoutAndAJumpOfTime at 10.
constexpr double head_dropout = 0.5;
/// Change of the difference between two clocks that counts as a step [s]; also how far messages may be out of order. If
/// smaller, late messages are mistaken for a step of the clock. Test: StreamClock.ASingleMessageDoesNotMoveTheClock at
/// 2.
constexpr double clock_slip = 0.1;
/// Largest relative drift of a sender's clock. If smaller, drift counts as a step. Test: StreamClock.DriftIsFollowed at
/// 0.
constexpr double clock_drift = 1e-3;
/// Number of messages that prove that a sender's clock was set. Test: StreamClock.ASingleMessageDoesNotMoveTheClock at
/// 1.
constexpr std::size_t step_messages = 3;
/// Range of stamps that these messages must cover [s]. If shorter, messages that waited in a queue count as a step.
/// Test: StreamClock.QueuedMessagesAreNoStep at 0.
constexpr double step_span = 0.05;
/// Time constant with which a slipped tool returns to the hand once the hand pulls with less than the limit [s]. If
/// shorter, the tool stays at its limit until the hand is back. Test: Slip.TheToolReturnsToTheHand at 10.
constexpr double slip_return_time = 0.1;
/// Distance from the hand at which a slipped tool has returned [m, rad]. Test: Slip.TheToolReturnsToTheHand at 0.1.
constexpr double no_gap = 1e-9;

}  // namespace spring_workbench::motion
