#pragma once

#include <cstddef>

namespace spring_workbench::fastrak {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] over which the first cadence is measured. Shorter: less exact. Test:
/// StationStream.StampsByTheCadenceThatItMeasures.
constexpr double cadence_measured_for = 3.0;
/// [s] of records that are kept as one point of the fit. Longer: more jitter. Test:
/// CadenceClock.JitterIsAtLeastTenTimesLessWhateverTheDrift.
constexpr double bucket = 0.5;
/// Number of such points that are kept. Fewer: more jitter. Test:
/// CadenceClock.JitterIsAtLeastTenTimesLessWhateverTheDrift.
constexpr std::size_t buckets = 20;
/// [s] of records before a drift is fitted. Shorter: jitter passes for drift. Test:
/// CadenceClock.DriftIsFollowedAfterTwoSeconds.
constexpr double shortest_fit = 2.0;
/// Largest relative drift of the cadence. Larger: a wrong cadence is followed. Test:
/// StationStream.MeasuresAnewACadenceThatProvesWrong.
constexpr double largest_drift = 5e-3;
/// [s] of late records after which records count as lost. Longer: stamps are wrong for longer. Test:
/// CadenceClock.LostRecordsAndStallsAreGotOver.
constexpr double late_for = 0.5;
/// Number of late records after which records count as lost, at low rates. Test:
/// CadenceClock.AfterALostRecordAtALowRateSixteenReceiptsDecide.
constexpr double late_in_a_row = 16.0;
/// [s] of silence in a stream after which records count as lost. Test: CadenceClock.LostRecordsAndStallsAreGotOver.
constexpr double stream_silence = 0.25;
/// [s] in which a correction of the count may be taken back. Shorter: stalls shift stamps. Test:
/// CadenceClock.LostRecordsAndStallsAreGotOver.
constexpr double recount_doubt = 2.0;
/// [s] least interval between stamps, so that they increase. Test: StationStream.BurstsMakeNoJumpBetweenSamples.
constexpr double shortest_stamp_interval = 1e-6;
/// [s] until another attempt to open a port. Longer: devices come back later. Test: Faults.PassNoWrongPoseAndEnd.
constexpr double look_again_after = 0.1;
/// [s] of silence after which the device is set up again. Shorter than an interval: no stream. Test:
/// Faults.PassNoWrongPoseAndEnd.
constexpr double source_silence = 0.25;
/// [s] for the device to reply. Too short: the set-up never ends. Test: FastrakSource.SaysWhatIsWrong.
constexpr double answer_time = 0.15;
/// [bytes] that may be in transit on the line. Fewer: a slow line never streams. Test:
/// FastrakSource.ReadsEveryModeThatItCanAskFor.
constexpr double line_bytes = 200.0;
/// [s] that the line is given in addition if the reading thread itself is late. Test: none: only a stopped process
/// meets it.
constexpr double late_reader_chance = 0.05;
/// Number of failed set-ups after which the port is opened again. Test: none: the stream starts in either case.
constexpr int attempts_per_opening = 5;
/// [s] that a write may take. Longer: a stuck port is reported later. Test: none: a pseudo-terminal always takes them.
constexpr double longest_write = 0.2;
/// [m] largest coordinate of a valid record, twice the tracker's reach. More: corrupted records pass. Test:
/// FastrakLayout.RefusesWhatNoTrackerMeasures.
constexpr double farthest_measured = 10.0;
/// Largest error of the norm of a quaternion in a valid record. More: corrupted records pass. Test:
/// FastrakLayout.RefusesWhatNoTrackerMeasures.
constexpr double norm_tolerance = 0.01;
/// Relative resolution of the extended format. Less: no record passes. Test:
/// FastrakLayout.WhatIsEncodedIsDecodedToTheDigitsOfTheFormat.
constexpr double extended_resolution = 1e-5;
/// [bytes] of the longest reply. More: a false start of a reply costs more. Test: FastrakDecoder.GetsOutOfAFalseStart.
constexpr std::size_t longest_reply = 256;

}  // namespace spring_workbench::fastrak
