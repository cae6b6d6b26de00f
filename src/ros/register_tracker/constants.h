#pragma once

#include <cstdint>

namespace spring_workbench::register_tracker {

// With its unit, the effect of a change, and the test that detects it.

/// Capacity of the queues of /tf and of the buttons [messages]: several seconds of four stations. If smaller, a busy
/// machine loses some. Test: register_tracker_test.py::test_messages_lost_at_a_full_queue_are_counted.
constexpr std::uint32_t input_queue = 1000;

}  // namespace spring_workbench::register_tracker
