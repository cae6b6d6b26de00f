#pragma once

#include <cstdint>

namespace spring_workbench::ros_common {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] between looks at a simulated clock. Longer: cycles begin later after their time. Test: none: later cycles give
/// the same states.
constexpr double clock_poll = 1e-3;
/// [s] for which a simulated clock that stands is waited for. Longer: callbacks of a stopped bag wait longer. Test:
/// none: nothing but the node's answers get slower.
constexpr double stopped_clock_patience = 0.1;
/// [s] that one look at the clock adds to attended time at most. Longer: what waits while the machine is busy counts as
/// silence. Test: faults_test.py::test_after_a_stopped_processor_time_is_the_hands_again.
constexpr double longest_attended = 0.01;
/// [ns] between readings of two clocks from which on they are read once more. Longer: stamps jitter more. Test: none:
/// only an interrupted process meets it.
constexpr std::int64_t clocks_apart = 50'000;
/// [s] of attended time in which the other stream may follow a jump back. Less: what a busy player sends late is lost.
/// Test: tools_test.py::test_both_start_anew_when_time_jumps_back.
constexpr double jump_patience = 1.0;
/// [s] for the answer of the node's own API. Longer: a node that is interrupted just then ends later. Test:
/// ended_nodes_test.py::test_all_end_in_order at 600.
constexpr double own_api_patience = 0.5;
/// [s] between two log lines of one reason to leave input out. Less: the log is flooded. Test:
/// machine_link_test.py::test_what_cannot_be_used_is_told_and_changes_nothing at 0.
constexpr double log_period = 5.0;

}  // namespace spring_workbench::ros_common
