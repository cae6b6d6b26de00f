#pragma once

namespace spring_workbench::hand_input {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] in which the re-acquisition speeds up from rest to its full speed. Longer: gentler. Test:
/// Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double ramp_time = 0.2;
/// [s] time constant with which the re-acquisition arrives, and with which a hand leaves its dead band. Longer:
/// gentler. Test: Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double tail_time = 0.1;
/// [s] that a hand must stay within the dead band before it counts as at rest. Shorter: a slow hand stops and goes.
/// Test: DeadBand.WhatATremblingHandHoldsSleepsWhileTheHandRests at 2.
constexpr double still_time = 0.3;
/// [m] from the goal, at which the re-acquisition ends in one step. More: the arrival jumps. Test:
/// Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double near = 1e-5;
/// [rad] likewise, for the rotation. Test: Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double near_angle = 1e-4;
/// [s] half of the resolution of ROS time, as in PoseTrack: stamps this close count as equal. More: samples are lost.
/// Test: SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double same_time = 0.5e-9;
/// [Hz] cut-off of the low-pass of the velocities. Lower: the filter opens later. Test:
/// PoseFilter.OpensWithTheLowPassedSpeed.
constexpr double velocity_cutoff = 8.0;
/// [m] a step shorter than this is never an outlier: it may be noise of the tracker. Less: noise between close stamps
/// is rejected. Test: SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double free_distance = 5e-3;
/// [rad] likewise, for the rotation. Test: SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double free_angle = 0.05;
/// [s] shortest interval between stamps from which a velocity is computed: a burst has none. Less: velocities of
/// bursts. Test: SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double closest = 5e-5;
/// The same as a fraction of the usual interval. Test: SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double closest_share = 0.25;
/// Multiple of origin_radius: a hand that was nearer than this may have moved to the origin by itself. Test:
/// SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double away_from_origin = 10.0;
/// Weight of a new interval in the smoothed one: an average over some ten samples. More: it follows jitter. Test:
/// PlayoutClock.SmoothsTheIntervalAndWaitsForSilence.
constexpr double share_of_new = 0.1;
/// [s] of attended time without a message after which a hand counts as silent. Shorter: so does a bag that is played
/// quickly. Test: PlayoutClock.SmoothsTheIntervalAndWaitsForSilence.
constexpr double shortest_silence = 0.2;

}  // namespace spring_workbench::hand_input
