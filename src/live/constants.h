#pragma once

#include <cstddef>

namespace spring_workbench::live {

// Each with its unit, what changing it does, and the test that notices.

/// [s] a jump of the hands' time by more than this is skipped, not simulated. Longer: such a jump is simulated in full.
/// Test: Clocks.ALeapIsLeftOutAndNothingMoves.
constexpr double longest_catch_up = 5.0;
/// [s] by which the epoch of a further stylus may lie before the simulated time. At least 1: in simulated time an epoch
/// begins at a whole second. Test: tools_test.py::test_second_stylus_takes_the_object_over.
constexpr double joining_slip = 1.5;
/// Number of prediction errors of which the 99 % quantile is reported. More: it follows changes more slowly. Test:
/// LookAhead.ErrorsAreThoseOfWhatWasShown.
constexpr std::size_t most_errors = 1000;
/// The quantile of the errors that is reported. Test: LookAhead.ErrorsAreThoseOfWhatWasShown.
constexpr double share_of_errors = 0.99;
/// Weight of the last commit in the smoothed cost. More: a commit that was interrupted counts for more. Test:
/// Pace.IsBehindWhereWhatIsTakenIsNotDoneSoon at 0.
constexpr double share_of_new_cost = 0.2;
/// [s] of accepted samples that are not simulated yet, both in simulated time and in processor time; beyond this,
/// simulated time slows down. Longer: what is shown is later. Test: Pace.IsBehindWhereWhatIsTakenIsNotDoneSoon at 0.1,
/// 5.
constexpr double longest_lag = 0.5;
/// [s] processor time that advancing the displayed copy may take. Longer: the committed simulation waits for it. Test:
/// Pace.IsBehindWhereWhatIsTakenIsNotDoneSoon at 0.001, 10.
constexpr double longest_look_ahead = 0.1;

/// Number of edits and resets that can be undone. More: each keeps a whole state. Test:
/// Undo.TakesBackAsManyEditsAsItSays.
constexpr std::size_t most_undone = 20;

}  // namespace spring_workbench::live
