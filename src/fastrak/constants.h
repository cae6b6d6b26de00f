#pragma once

#include <cstddef>

namespace spring_workbench::fastrak {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Time over which the sample rate is first measured [s]. If shorter, the rate is less accurate. Test:
/// StationStream.StampsByTheCadenceThatItMeasures.
constexpr double cadence_measuring_time = 3.0;
/// Duration of records that are represented by one point of the fit [s]. If longer, stamps have more jitter. Test:
/// CadenceClock.JitterIsAtLeastTenTimesLessWhateverTheDrift.
constexpr double bucket = 0.5;
/// Number of such points that are kept. If fewer, stamps have more jitter. Test:
/// CadenceClock.JitterIsAtLeastTenTimesLessWhateverTheDrift.
constexpr std::size_t buckets = 20;
/// Duration of records needed before a drift is fitted [s]. If shorter, jitter is mistaken for drift. Test:
/// CadenceClock.DriftIsFollowedAfterTwoSeconds.
constexpr double shortest_fit = 2.0;
/// Largest relative drift of the sample rate. If larger, a wrong rate is followed. Test:
/// StationStream.MeasuresAWrongRateAgain.
constexpr double largest_drift = 5e-3;
/// Duration of late records after which earlier ones are assumed lost [s]. If longer, stamps are wrong for longer.
/// Test: CadenceClock.RecoversFromLostRecordsAndStalls.
constexpr double late_duration = 0.5;
/// Number of late records after which earlier ones are assumed lost, at low rates. Test:
/// CadenceClock.AfterALostRecordAtALowRateSixteenReceiptsDecide.
constexpr double late_in_a_row = 16.0;
/// Duration of silence in a stream after which records are assumed lost [s]. Test:
/// CadenceClock.RecoversFromLostRecordsAndStalls.
constexpr double stream_silence = 0.25;
/// Time within which a correction of the count can be undone [s]. If shorter, stalls shift stamps. Test:
/// CadenceClock.RecoversFromLostRecordsAndStalls.
constexpr double recount_window = 2.0;
/// Minimum interval between stamps, so that they increase [s]. Test: StationStream.BurstsMakeNoJumpBetweenSamples.
constexpr double shortest_stamp_interval = 1e-6;
/// Time until another attempt to open a port [s]. If longer, devices come back later. Test:
/// Faults.PassNoWrongPoseAndEnd.
constexpr double retry_interval = 0.1;
/// Duration of silence after which the device is set up again [s]. If shorter than a sample interval, no stream starts.
/// Test: Faults.PassNoWrongPoseAndEnd.
constexpr double source_silence = 0.25;
/// Time allowed for the device's reply [s]. If too short, the set-up never finishes. Test:
/// FastrakSource.ReportsWhatIsWrong.
constexpr double answer_time = 0.15;
/// Number of bytes that may be in transit on the line. If smaller, a slow line never streams. Test:
/// FastrakSource.ReadsEveryModeThatItCanAskFor.
constexpr double line_bytes = 200.0;
/// Extra time for the line if the reading thread itself is late [s]. Test: none: it only matters after the process was
/// stopped.
constexpr double late_reader_grace = 0.05;
/// Number of failed set-ups after which the port is reopened. Test: none: the stream starts in either case.
constexpr int attempts_per_opening = 5;
/// Timeout of a write [s]. If longer, a stuck port is reported later. Test: none: a pseudo-terminal accepts every
/// write.
constexpr double longest_write = 0.2;
/// Largest coordinate of a valid record, twice the tracker's reach [m]. If larger, corrupted records pass. Test:
/// FastrakLayout.RefusesImplausibleRecords.
constexpr double farthest_measured = 10.0;
/// Largest deviation from 1 of a quaternion's norm in a valid record. If larger, corrupted records pass. Test:
/// FastrakLayout.RefusesImplausibleRecords.
constexpr double norm_tolerance = 0.01;
/// Relative resolution of the extended format. If smaller, no record passes. Test:
/// FastrakLayout.WhatIsEncodedIsDecodedToTheDigitsOfTheFormat.
constexpr double extended_resolution = 1e-5;
/// Length of the longest reply [bytes]. If larger, a false start of a reply costs more. Test:
/// FastrakDecoder.RecoversFromAFalseStart.
constexpr std::size_t longest_reply = 256;

}  // namespace spring_workbench::fastrak
