#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::objects {

/// [s] for which a free body is slow before it sleeps. Larger: it costs longer. With `dynamic` 0.5 s. Test:
/// Simulation.BoxThatIsDroppedComesToRestOnTheBench at 20.
constexpr double asleep_after = 0.2;
/// [m] from the origin; a body that flies further stops there. Test: Simulation.WhatFliesAwayStopsAtTheEndOfTheWorld.
constexpr double world_limit = 100.0;
/// [m] from the path of a body within which others are near it. Larger: two that fly into each other are less often
/// carried as a pair. Test: LooseThrows.NothingGoesDeepOrGainsEnergy at 200.
constexpr double margin_near = 5e-4;

}  // namespace spring_workbench::objects
