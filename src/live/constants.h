#pragma once

#include <cstddef>

namespace spring_workbench::live {

// Each with its unit, what changing it does, and the test that notices.

/// [s] beyond which time has leapt and is left out. Longer: a leap is simulated in full. Test:
/// Clocks.ALeapIsLeftOutAndNothingMoves.
constexpr double longest_catch_up = 5.0;
/// [s] by which a further stylus may begin before the simulated time and still join. At least 1: in simulated time an
/// epoch begins at a whole second. Test: tools_test.py::test_second_stylus_takes_the_object_over.
constexpr double joining_slip = 1.5;
/// errors of prediction of which the 99 % are reported. More: they follow slower. Test:
/// LookAhead.ErrorsAreThoseOfWhatWasShown.
constexpr std::size_t most_errors = 1000;
/// share of the errors that are not larger than the one reported. Test: LookAhead.ErrorsAreThoseOfWhatWasShown.
constexpr double share_of_errors = 0.99;
/// of a commit's cost in the smoothed one. More: one that was interrupted counts for more. Test:
/// Pace.IsBehindWhereWhatIsTakenIsNotDoneSoon at 0.
constexpr double share_of_new_cost = 0.2;
/// [s] of what is taken and not simulated yet, in simulated time and in work; beyond both simulated time slows down.
/// Longer: what is shown is later. Test: Pace.IsBehindWhereWhatIsTakenIsNotDoneSoon at 0.1, 5.
constexpr double longest_lag = 0.5;
/// [s] of work that a look ahead may take. Longer: what is committed waits for it. Test:
/// Pace.IsBehindWhereWhatIsTakenIsNotDoneSoon at 0.001, 10.
constexpr double longest_look_ahead = 0.1;

/// edits and resets that can be taken back. More: each keeps a whole state. Test:
/// Undo.TakesBackAsManyEditsAsItSays.
constexpr std::size_t most_undone = 20;

}  // namespace spring_workbench::live
