#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::instruments {

/// Of the heaviest object's weight to the lightest's, from which on colours go by the logarithm of the load. Test:
/// LoadScale.EveryWeightOfTheMiniWorldHasItsPlace.
constexpr double one_decade = 10.0;
/// Of the lightest object's weight: where logarithmic colours begin. More: the lightest one looks like no load. Test:
/// LoadScale.EveryWeightOfTheMiniWorldHasItsPlace.
constexpr double below_lightest = 0.5;
/// [s] of one part of an average. Shorter: what swings slower than that makes the uncertainty too small. Test:
/// ReadingAverage.CoversTheTruthAsOftenAsItSays at 0.01.
constexpr double reading_part = 0.1;
/// Parts of an average. More: it is slower. Test: ReadingAverage.IsOfTheLastSecond at 20.
constexpr std::size_t reading_parts = 10;

}  // namespace spring_workbench::instruments
