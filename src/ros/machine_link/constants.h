#pragma once

#include <cstddef>
#include <cstdint>

namespace spring_workbench::machine_link {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// messages of a sensor that wait while the machine is busy. Fewer: a force between two of them is lost. Test:
/// machine_link_test.py::test_every_measurement_is_taken at 1.
constexpr std::uint32_t input_queue = 2000;
/// measurements of one sensor that wait while the loop is stalled; further ones are rejected. Fewer: some are lost if
/// it is stalled for a moment. Test: Inbox.HoldsNoMoreThanItMay.
constexpr std::size_t most_waiting = 20000;

}  // namespace spring_workbench::machine_link
