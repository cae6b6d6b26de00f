#pragma once

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::objects {

/// Distance from the origin at which a flying body is stopped [m]. Test:
/// Simulation.AFlyingObjectStopsAtTheEndOfTheWorld.
constexpr double world_limit = 100.0;

}  // namespace spring_workbench::objects
