#pragma once

#include <cstddef>

namespace spring_workbench::simulated_fastrak {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [m] what three digits of centimetres hold. Test: limits_test.py::test_programs.
constexpr double farthest_played = 9.99;
/// [bytes] of a fault. More: more records lost at once. Test: LineFaults.AddEightyBytesOfNoiseAtMost.
constexpr std::size_t longest_noise = 80;
/// [bytes] nobody read. Fewer: dropped. Test: FastrakSource.LosesNoRecordInTenMinutesOfFourStations.
constexpr std::size_t most_waiting = 4096;

}  // namespace spring_workbench::simulated_fastrak
