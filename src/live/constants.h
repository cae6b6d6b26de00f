#pragma once

#include <cstddef>

namespace spring_workbench::live {

// Each with its unit, the effect of a change, and the test that detects it.

/// Longest jump of the hands' time that is simulated [s]; a longer one is skipped. If longer, such a jump is simulated
/// in full. Test: Clocks.ATimeJumpIsSkippedAndNothingMoves.
constexpr double longest_catch_up = 5.0;
/// Time by which the epoch of another stylus may precede the simulated time [s]. At least 1: in simulated time an epoch
/// begins at a whole second. Test: tools_test.py::test_second_stylus_takes_the_object_over.
constexpr double joining_slip = 1.5;
/// Number of prediction errors of which the 99 % quantile is reported. If more, it follows changes more slowly. Test:
/// LookAhead.ErrorsAreThoseOfTheDisplayedPoses.
constexpr std::size_t max_errors = 1000;
/// The quantile of the errors that is reported. Test: LookAhead.ErrorsAreThoseOfTheDisplayedPoses.
constexpr double error_quantile = 0.99;
/// Weight of the last commit in the smoothed cost. If larger, an interrupted commit distorts it more. Test:
/// Pace.IsBehindIfAcceptedSamplesAreNotSimulatedSoon at 0.
constexpr double new_cost_weight = 0.2;
/// Backlog of accepted samples, in simulated time and in processor time, beyond which simulated time slows down [s]. If
/// longer, the display lags more. Test: Pace.IsBehindIfAcceptedSamplesAreNotSimulatedSoon at 0.1, 5.
constexpr double longest_lag = 0.5;
/// Maximum processor time for advancing the displayed copy [s]. If longer, it delays the committed simulation. Test:
/// Pace.IsBehindIfAcceptedSamplesAreNotSimulatedSoon at 0.001, 10.
constexpr double longest_look_ahead = 0.1;
/// Processor time of a commit beyond which the next cycle continues it [s]. If longer, services wait longer while the
/// simulation cannot keep up; if shorter than a usual commit, the loop goes round more often. Test:
/// Pace.ACycleCommitsWhatItCanSimulateInTime.
constexpr double longest_cycle = 0.1;

/// Number of edits and resets that can be undone. If more, more memory is needed: a whole state for each. Test:
/// Undo.UndoesTheDocumentedNumberOfEdits.
constexpr std::size_t max_undo_steps = 20;

}  // namespace spring_workbench::live
