#pragma once

#include <cstdint>

namespace spring_workbench::machine_link {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// messages of a sensor that wait while the machine is busy. Fewer: a force between two of them is lost. Test:
/// machine_link_test.py::test_every_measurement_is_taken at 1.
constexpr std::uint32_t input_queue = 2000;
/// [s] between two log lines of one reason to leave wrenches out. Less: the log is flooded. Test:
/// machine_link_test.py::test_what_cannot_be_used_is_told_and_changes_nothing at 0.
constexpr double told_again_after = 5.0;

}  // namespace spring_workbench::machine_link
