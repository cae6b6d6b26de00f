#pragma once

#include <cstddef>

// The constants of the module: unit, what changing one does, and the test that notices: "noticed by" was seen to fail
// with another value, "goes into" is by reading alone.

namespace spring_workbench::motion {

/// [s] between samples, half of what ROS time resolves; one that comes sooner is left out. Noticed by
/// `PoseTrack.EqualAndBackwardStampsAreLeftOut`.
constexpr double shortest_interval = 0.5e-9;
/// [s]; a stamp beyond it is refused. Noticed by `PoseTrack.RefusesWhatIsNotAPoseAndStaysAsItWas`.
constexpr double farthest_time = 1e12;
/// [m]; a coordinate beyond it is refused. Noticed by `PoseTrack.RefusesWhatIsNotAPoseAndStaysAsItWas`.
constexpr double farthest_position = 1e9;
/// Of RᵀR − I; what is off by more is no rotation and refused. Noticed by
/// `PoseTrack.RefusesWhatIsNotAPoseAndStaysAsItWas`.
constexpr double rotation_tolerance = 1e-6;
/// Over which the figures of a stream are smoothed. Noticed by `StreamMonitor.SaysRateJitterGapsAndAge`.
constexpr std::size_t monitored_samples = 50;
/// [m, rad]; a follower so near to its goal is there. Goes into
/// `PoseFollower.ComesToEveryGoalNeverFasterThanAHandAndNeverAway`.
constexpr double arrived = 1e-9;
/// [s] before the newest sample from which a line is fitted. Longer: less noise, more lag. Goes into
/// `PosePredictor.FollowsAParabolaExactlyAndALineThroughNoise`.
constexpr double line_window = 0.03;
/// [s] ahead up to which a line predicts. Goes into `PosePredictor.FollowsAParabolaExactlyAndALineThroughNoise`.
constexpr double line_horizon = 0.02;
/// [s] before the newest sample from which a parabola is fitted. Goes into
/// `PosePredictor.FollowsAParabolaExactlyAndALineThroughNoise`.
constexpr double parabola_window = 0.12;
/// Of the determinant of a fit to the product of its diagonal; samples closer together than that say no parabola. Goes
/// into `PosePredictor.FollowsAParabolaExactlyAndALineThroughNoise`.
constexpr double least_spread = 1e-6;

}  // namespace spring_workbench::motion
