#pragma once

#include <cstddef>
#include <cstdint>

namespace spring_workbench::manipulation {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Queue size of a topic for a slow subscriber, and maximum number of unsent committed states (beyond that, the loop
/// waits). If smaller, a burst of steps loses some. Test:
/// played_recordings_test.py::test_a_hundred_rounds_are_the_same.
constexpr std::uint32_t state_queue = 1000;
/// Queue size for /tf and button messages while the machine is busy. If smaller, samples are lost. Test:
/// played_recordings_test.py::test_a_hundred_rounds_are_the_same.
constexpr std::uint32_t input_queue = 2000;
/// Maximum number of messages of a stream that are kept during a time jump. If smaller, the first ones after a jump are
/// lost. Test: none: no test has that many.
constexpr std::size_t max_early_messages = 2000;
/// Maximum number of child frames in a hint. If larger, hints are longer. Test: none: a line for the user.
constexpr std::size_t max_named_frames = 20;
/// Maximum number of events of one stylus that wait while the loop is stalled; further ones are rejected. If smaller,
/// samples are lost while a scene is loaded. Test: Inbox.HoldsNoMoreThanItsCapacity.
constexpr std::size_t max_waiting = 20000;
/// Time between two hints why no sample of the stylus is used [s]. Test: none: a line for the user.
constexpr double hint_period = 10.0;
/// Time without a reply after which the master counts as dead [s]. If shorter, so does a busy one. Test:
/// master_test.py::test_nothing_is_noticed_without_a_master.
constexpr double master_timeout = 3.0;
/// Time between checkpoints [s]. If longer, a killed node resumes from an older state. Test:
/// faults_test.py::test_a_killed_node_comes_back_as_it_was.
constexpr double checkpoint_period = 0.5;
/// Time after which an unchanged state is sent again, for late subscribers [s]. If longer, they wait longer. Test:
/// manipulation_test.py::test_bad_calls_change_nothing.
constexpr double repeat_after = 0.1;
/// Time between two checks whether the scene has changed [s]. If longer, rviz shows the old one for longer. Test:
/// manipulation_test.py::test_a_late_listener_gets_the_scene at 100.
constexpr double scene_period = 0.1;

}  // namespace spring_workbench::manipulation
