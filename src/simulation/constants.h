#pragma once

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::simulation {

/// Length of a rigid tool [m]; it has no effect but must be positive. Test: Tools.DirectAndRayAreRigid at 0.
constexpr double min_length = 1e-4;
/// Reach of the tool `ray` [m]. Test: Tools.DirectAndRayAreRigid at 0.2.
constexpr double longest_ray = 2.0;
/// Ratio of distances below which another object replaces the highlighted one. At 1, a trembling tip alternates between
/// two objects. Test: Overlapping.TheOtherIsSelectedOnlyIfItIsNearerByAFifth.
constexpr double switch_ratio = 0.8;

}  // namespace spring_workbench::simulation
