#pragma once

namespace spring_workbench::fastrak_simulator {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Time between checks of `interrupted` [s]. If longer, the program exits later. Test: none: it only exits later.
constexpr double longest_wait = 0.05;

}  // namespace spring_workbench::fastrak_simulator
