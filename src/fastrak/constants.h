#pragma once

#include <cstddef>

namespace spring_workbench::fastrak {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] that give the first cadence. Shorter: a worse one. Test: StationStream.StampsByTheCadenceThatItMeasures.
constexpr double cadence_measured_for = 3.0;
/// [s] kept as one point. Longer: more jitter. Test: CadenceClock.JitterIsAtLeastTenTimesLessWhateverTheDrift.
constexpr double bucket = 0.5;
/// of them kept. Fewer: more jitter. Test: CadenceClock.JitterIsAtLeastTenTimesLessWhateverTheDrift.
constexpr std::size_t buckets = 20;
/// [s] before drift counts. Shorter: jitter passes for it. Test: CadenceClock.DriftIsFollowedAfterTwoSeconds.
constexpr double shortest_fit = 2.0;
/// relative. Larger: a wrong cadence is followed. Test: StationStream.MeasuresAnewACadenceThatProvesWrong.
constexpr double largest_drift = 5e-3;
/// [s] late: records were lost. Longer: wrong for longer. Test: CadenceClock.LostRecordsAndStallsAreGotOver.
constexpr double late_for = 0.5;
/// receipts, the same at low rates. Test: CadenceClock.AfterALostRecordAtALowRateSixteenReceiptsDecide.
constexpr double late_in_a_row = 16.0;
/// [s] of silence in a stream, in which records were lost. Test: CadenceClock.LostRecordsAndStallsAreGotOver.
constexpr double stream_silence = 0.25;
/// [s] to take a count back. Shorter: stalls shift stamps. Test: CadenceClock.LostRecordsAndStallsAreGotOver.
constexpr double recount_doubt = 2.0;
/// [s] between stamps, so that they increase. Test: StationStream.BurstsMakeNoJumpBetweenSamples.
constexpr double shortest_stamp_interval = 1e-6;
/// [s] after a port did not open. Longer: devices come back later. Test: Faults.PassNoWrongPoseAndEnd.
constexpr double look_again_after = 0.1;
/// [s] until a new set-up. Shorter than an interval: no stream. Test: Faults.PassNoWrongPoseAndEnd.
constexpr double source_silence = 0.25;
/// [s] for the device to answer. Too short: the set-up never ends. Test: FastrakSource.SaysWhatIsWrong.
constexpr double answer_time = 0.15;
/// on the line at once. Fewer: a slow line never streams. Test: FastrakSource.ReadsEveryModeThatItCanAskFor.
constexpr double line_bytes = 200.0;
/// [s] that the line is given if the reading thread itself is late. Test: none: only a stopped process meets it.
constexpr double late_reader_chance = 0.05;
/// failed set-ups after which the port is opened again. Test: none: the stream starts in either case.
constexpr int attempts_per_opening = 5;
/// [s] for a write. Longer: a stuck port shows later. Test: none: a pseudo-terminal always takes them.
constexpr double longest_write = 0.2;
/// [m] twice the reach. More: spoilt records pass. Test: FastrakLayout.RefusesWhatNoTrackerMeasures.
constexpr double farthest_measured = 10.0;
/// of a quaternion's length. More: spoilt records pass. Test: FastrakLayout.RefusesWhatNoTrackerMeasures.
constexpr double norm_tolerance = 0.01;
/// relative. Less: none passes. Test: FastrakLayout.WhatIsEncodedIsDecodedToTheDigitsOfTheFormat.
constexpr double extended_resolution = 1e-5;
/// [bytes] More: a false start costs more. Test: FastrakDecoder.GetsOutOfAFalseStart.
constexpr std::size_t longest_reply = 256;

}  // namespace spring_workbench::fastrak
