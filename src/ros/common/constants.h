#pragma once

#include <cstdint>

namespace spring_workbench::ros_common {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] between two readings of a simulated clock. Longer: cycles begin later. Test: none: later cycles give the same
/// states.
constexpr double clock_poll = 1e-3;
/// [s] for which a simulated clock that has stopped is waited for. Longer: callbacks of a paused bag wait longer. Test:
/// none: nothing but the node's answers get slower.
constexpr double stopped_clock_patience = 0.1;
/// [s] that one reading of the clock adds to attended time at most. Longer: messages that wait while the machine is
/// busy count as silence. Test: faults_test.py::test_after_a_stopped_processor_time_is_the_hands_again.
constexpr double longest_attended = 0.01;
/// [ns] between the readings of two clocks above which both are read again. Longer: stamps jitter more. Test: none:
/// only an interrupted process meets it.
constexpr std::int64_t clocks_apart = 50'000;
/// [s] of attended time in which the other stream may follow a time jump. Less: messages that a busy player sends late
/// are lost. Test: tools_test.py::test_both_start_anew_when_time_jumps_back.
constexpr double jump_patience = 1.0;
/// [s] between two looks at the ROS master. Longer: a restarted master lists the node later. Test: none: its deadline
/// is many times as long.
constexpr double master_period = 1.0;
/// Looks at a restarted master from the registration of publishers to that of subscribers. Fewer: subscribers lose
/// publishers that are not registered again yet. Test:
/// master_test.py::test_a_new_master_lists_the_nodes_again at 0.
constexpr int subscribers_later = 2;
/// [s] for the reply of the node's own API. Longer: a node that is interrupted then ends later. Test:
/// ended_nodes_test.py::test_all_end_in_order at 600.
constexpr double own_api_patience = 0.5;
/// [s] that the end of a node may take. Longer: with a master that hangs, it ends later. Test:
/// master_test.py::test_nothing_is_noticed_while_the_master_hangs at 30.
constexpr double longest_end = 1.5;
/// [s] between two log lines about one reason of rejection. Less: the log is flooded. Test:
/// machine_link_test.py::test_what_cannot_be_used_is_told_and_changes_nothing at 0.
constexpr double log_period = 5.0;

}  // namespace spring_workbench::ros_common
