#pragma once

#include <cstddef>
#include <cstdint>

namespace spring_workbench::manipulation {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// messages of one topic that wait for a slow subscriber, and committed states whose messages are not made yet (beyond
/// them the loop waits). Fewer: a run of steps without pause loses some. Test:
/// played_recordings_test.py::test_a_hundred_rounds_are_the_same.
constexpr std::uint32_t state_queue = 1000;
/// messages of /tf or of buttons that wait while the machine is busy. Fewer: samples are lost. Test:
/// played_recordings_test.py::test_a_hundred_rounds_are_the_same.
constexpr std::uint32_t input_queue = 2000;
/// messages of a stream that are kept over a jump of time. Fewer: the first after a jump are lost. Test: none: no test
/// has a jump over so many.
constexpr std::size_t most_early = 2000;
/// child frames that a hint can name. More: longer hints. Test: none: a line for people.
constexpr std::size_t most_named_frames = 20;
/// events of one stylus that wait while the loop stands; what comes then is rejected. Fewer: samples are lost where a
/// scene is loaded. Test: Inbox.HoldsNoMoreThanItMay.
constexpr std::size_t most_waiting = 20000;
/// [s] between two hints why no sample of the stylus is used. Test: none: a line for people.
constexpr double hint_patience = 10.0;
/// [s] without an answer after which the master counts as gone. Shorter: a busy one counts, too. Test:
/// master_test.py::test_nothing_is_noticed_without_a_master.
constexpr double master_patience = 3.0;
/// [s] between checkpoints. Longer: a killed node goes on from an older state. Test:
/// faults_test.py::test_a_killed_node_comes_back_as_it_was.
constexpr double checkpoint_period = 0.5;
/// [s] after which a state that stays as it is is sent again, for who came late. Longer: they wait. Test:
/// manipulation_test.py::test_bad_calls_change_nothing.
constexpr double repeat_after = 0.1;
/// [s] between two looks whether the scene was changed. Longer: rviz draws the old one for longer. Test:
/// manipulation_test.py::test_a_late_listener_gets_the_scene at 100.
constexpr double scene_period = 0.1;

}  // namespace spring_workbench::manipulation
