#pragma once

#include <cstddef>

namespace spring_workbench::simulated_fastrak {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Largest coordinate that three digits of centimetres can represent [m]. Test: limits_test.py::test_programs.
constexpr double farthest_played = 9.99;
/// Maximum length of garbage [bytes]. If larger, more records are lost at once. Test:
/// LineFaults.AddEightyBytesOfNoiseAtMost.
constexpr std::size_t longest_noise = 80;
/// Maximum unread output [bytes]. If smaller, records are dropped. Test:
/// FastrakSource.LosesNoRecordInTenMinutesOfFourStations.
constexpr std::size_t max_waiting = 4096;

}  // namespace spring_workbench::simulated_fastrak
