#pragma once

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::objects {

/// Time for which a free body must be slow before it is put to sleep [s] (0.5 s with `dynamic`). If longer, it costs
/// processor time for longer. Test: Simulation.BoxThatIsDroppedComesToRestOnTheBench at 20.
constexpr double asleep_after = 0.2;
/// Distance from the origin at which a flying body is stopped [m]. Test:
/// Simulation.AFlyingObjectStopsAtTheEndOfTheWorld.
constexpr double world_limit = 100.0;
/// Distance from the path of a body within which others count as near [m]. If larger, two colliding bodies are less
/// often stepped as a pair. Test: LooseThrows.NothingGoesDeepOrGainsEnergy at 200.
constexpr double margin_near = 5e-4;

}  // namespace spring_workbench::objects
