#pragma once

#include <cstdint>

namespace spring_workbench::ros_common {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Time between two readings of a simulated clock [s]. If longer, cycles start later. Test: none: later cycles give the
/// same states.
constexpr double clock_poll = 1e-3;
/// Maximum wait for a simulated clock that has stopped [s]. If longer, callbacks wait longer while a bag is paused.
/// Test: none: only the node's responses get slower.
constexpr double stopped_clock_timeout = 0.1;
/// Maximum increase of running time by one reading of the clock [s]. If longer, messages that wait while the machine
/// is busy count as silence. Test: faults_test.py::test_after_a_stopped_processor_time_is_the_hands_again.
constexpr double max_running_increase = 0.01;
/// Time between the readings of two clocks above which both are read again [ns]. If longer, stamps jitter more. Test:
/// none: it only matters if the process is interrupted.
constexpr std::int64_t clocks_apart = 50'000;
/// Attended time within which the other stream may follow a time jump [s]. If smaller, messages that a busy player
/// sends late are lost. Test: tools_test.py::test_both_restart_when_time_jumps_back.
constexpr double jump_timeout = 1.0;
/// Time between two checks of the ROS master [s]. If longer, a restarted master lists the node later. Test: none: its
/// deadline is many times as long.
constexpr double master_period = 1.0;
/// Number of checks of a restarted master between the registration of publishers and that of subscribers. If fewer,
/// subscribers lose publishers that are not registered again yet. Test:
/// master_test.py::test_a_new_master_lists_the_nodes_again_after_one_that_hung at 0.
constexpr int subscribers_later = 2;
/// Timeout for the reply of the node's own API [s]. If longer, a node that is interrupted meanwhile exits later. Test:
/// ended_nodes_test.py::test_all_end_in_order at 600.
constexpr double own_api_timeout = 0.5;
/// Maximum time for the shutdown of a node [s]. If longer, the node exits later when the master hangs. Test:
/// master_test.py::test_nothing_is_noticed_while_the_master_hangs at 30.
constexpr double shutdown_timeout = 1.5;
/// Time between two log lines about one reason of rejection [s]. If smaller, the log is flooded. Test:
/// machine_link_test.py::test_invalid_wrenches_are_reported_and_change_nothing at 0.
constexpr double log_period = 5.0;

}  // namespace spring_workbench::ros_common
