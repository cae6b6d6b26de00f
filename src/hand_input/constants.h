#pragma once

namespace spring_workbench::hand_input {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] from rest to the full speed of catching up. Longer: gentler. Test:
/// Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double ramp_time = 0.2;
/// [s] time constant of the arrival, and of a hand that leaves its dead band. Longer: gentler. Test:
/// Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double tail_time = 0.1;
/// [s] for which a hand stays within the dead band until it rests. Shorter: a slow hand stops and goes. Test:
/// DeadBand.WhatATremblingHandHoldsSleepsWhileTheHandRests at 2.
constexpr double still_time = 0.3;
/// [m] where the rest of the way is made in one step. More: the arrival jumps. Test:
/// Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double near = 1e-5;
/// [rad] the same of turning. Test: Reacquisition.ComesInOverItsRampAndArrivesWithItsTimeConstant.
constexpr double near_angle = 1e-4;
/// [s] half of what ROS time resolves, as PoseTrack has it: stamps this close are the same. More: samples are lost.
/// Test: SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double same_time = 0.5e-9;
/// [Hz] of the low-pass of the velocities. Lower: the filter opens later. Test: PoseFilter.OpensWithTheLowPassedSpeed.
constexpr double velocity_cutoff = 8.0;
/// [m] a step below is never an outlier: noise of a tracker. Less: noise of close stamps is left out. Test:
/// SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double free_distance = 5e-3;
/// [rad] the same of turning. Test: SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double free_angle = 0.05;
/// [s] after the last sample, in which a burst says no velocity. Less: velocities of bursts. Test:
/// SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double closest = 5e-5;
/// of the usual interval, likewise. Test: SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double closest_share = 0.25;
/// times origin_radius; a hand that was nearer may have come to the origin by itself. Test:
/// SampleGate.WhatAHandCanAlwaysHaveDone.
constexpr double away_from_origin = 10.0;
/// of an interval in the usual one: smooths over some ten samples. More: it follows jitter. Test:
/// PlayoutClock.SmoothsTheIntervalAndWaitsForSilence.
constexpr double share_of_new = 0.1;
/// [s] of attended time without a message. Shorter: a bag played quickly counts as stopped. Test:
/// PlayoutClock.SmoothsTheIntervalAndWaitsForSilence.
constexpr double shortest_silence = 0.2;

}  // namespace spring_workbench::hand_input
