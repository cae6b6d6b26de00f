#pragma once

namespace spring_workbench::hand_input {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Time in which the re-acquisition accelerates from rest to its full speed [s]. If longer, it is gentler. Test:
/// Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double ramp_time = 0.2;
/// Time constant of the final approach of the re-acquisition, and of leaving the dead band [s]. If longer, it is
/// gentler. Test: Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double tail_time = 0.1;
/// Time that a hand must stay within the dead band before it counts as at rest [s]. If shorter, a slow hand moves
/// jerkily. Test: DeadBand.WhatATremblingHandHoldsSleepsWhileTheHandRests at 2.
constexpr double still_time = 0.3;
/// Distance from the goal at which the re-acquisition ends [m]. If larger, it ends with a jump. Test:
/// Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double near = 1e-5;
/// The same for rotation [rad]. Test: Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double near_angle = 1e-4;
/// Half of the resolution of ROS time [s], as in PoseTrack: stamps this close count as equal. If larger, samples are
/// lost. Test: SampleGate.AcceptsWhatAHandCanAlwaysDo.
constexpr double same_time = 0.5e-9;
/// Cut-off of the low-pass of the velocities [Hz]. If lower, the filter opens later. Test:
/// PoseFilter.OpensWithTheLowPassedSpeed.
constexpr double velocity_cutoff = 8.0;
/// Length of a step [m] below which it is never an outlier, because it may be tracker noise. If smaller, noise between
/// close stamps is rejected. Test: SampleGate.AcceptsWhatAHandCanAlwaysDo.
constexpr double free_distance = 5e-3;
/// The same for rotation [rad]. Test: SampleGate.AcceptsWhatAHandCanAlwaysDo.
constexpr double free_angle = 0.05;
/// Shortest interval between stamps from which a velocity is computed [s]. If smaller, bursts of samples give
/// meaningless velocities. Test: SampleGate.AcceptsWhatAHandCanAlwaysDo.
constexpr double closest = 5e-5;
/// The same as a fraction of the usual interval. Test: SampleGate.AcceptsWhatAHandCanAlwaysDo.
constexpr double closest_share = 0.25;
/// Multiple of origin_radius: a hand that was nearer than this may really have moved to the origin. Test:
/// SampleGate.AcceptsWhatAHandCanAlwaysDo.
constexpr double away_from_origin = 10.0;
/// Weight of a new interval in the smoothed one: an average over about ten samples. If larger, it follows jitter. Test:
/// PlayoutClock.SmoothsTheIntervalAndWaitsForSilence.
constexpr double new_interval_weight = 0.1;
/// Attended time without a message after which a hand counts as silent [s]. If shorter, so does a bag that is played
/// fast. Test: PlayoutClock.SmoothsTheIntervalAndWaitsForSilence.
constexpr double shortest_silence = 0.2;

}  // namespace spring_workbench::hand_input
