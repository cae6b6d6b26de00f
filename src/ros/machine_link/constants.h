#pragma once

#include <cstddef>
#include <cstdint>

namespace spring_workbench::machine_link {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Queue size for a sensor's messages while the machine is busy. If smaller, measurements are lost. Test:
/// machine_link_test.py::test_every_measurement_is_taken at 1.
constexpr std::uint32_t input_queue = 2000;
/// Maximum number of measurements of one sensor that wait while the loop is stalled; further ones are rejected. If
/// smaller, some are lost in a short stall. Test: Inbox.HoldsNoMoreThanItsCapacity.
constexpr std::size_t max_waiting = 20000;

}  // namespace spring_workbench::machine_link
