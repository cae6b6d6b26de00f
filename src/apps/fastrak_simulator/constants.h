#pragma once

namespace spring_workbench::fastrak_simulator {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] between looks at `interrupted`. Longer: it ends later. Test: none: it ends later.
constexpr double longest_wait = 0.05;

}  // namespace spring_workbench::fastrak_simulator
