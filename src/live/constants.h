#pragma once

#include <cstddef>

namespace spring_workbench::live {

// Each with its unit, what changing it does, and the test that notices.

/// [s] beyond which time has leapt and is left out. Longer: a leap is simulated in full. Test:
/// Clocks.ALeapIsLeftOutAndNothingMoves.
constexpr double longest_catch_up = 5.0;
/// [s] by which a second stylus may begin before the simulated time and still join. At least 1: in simulated time an
/// epoch begins at a whole second. Test: tools_test.py::test_second_stylus_takes_the_object_over.
constexpr double joining_slip = 1.5;
/// errors of prediction of which the 99 % are reported. More: they follow slower. Test:
/// LookAhead.ErrorsAreThoseOfWhatWasShown.
constexpr std::size_t most_errors = 1000;
/// share of the errors that are not larger than the one reported. Test: LookAhead.ErrorsAreThoseOfWhatWasShown.
constexpr double share_of_errors = 0.99;

}  // namespace spring_workbench::live
