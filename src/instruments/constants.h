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
/// [N·s] of a strike that is felt with full intensity, in real units. Less: weak ones feel like strong ones. Test:
/// Vibration.AStrikeIsFeltInProportionInRealUnitsAndDiesAway.
constexpr double full_strike = 0.5;
/// [N/s]; a force that changes so fast is felt with full intensity. Less: a hand that only moves feels it. Test:
/// Vibration.AJoltIsTheRateOfTheForce.
constexpr double full_jolt = 2000.0;
/// [s] in which what is felt goes down to 1/e. Longer: strikes blur into one. Test:
/// Vibration.AStrikeIsFeltInProportionInRealUnitsAndDiesAway.
constexpr double vibration_time = 0.05;
/// Intensity below which nothing is felt, so that it ends. More: weak strikes are not felt. Test:
/// Vibration.AStrikeIsFeltInProportionInRealUnitsAndDiesAway at 0.
constexpr double least_vibration = 0.02;

/// Samples of a touch that the material is identified from: ten seconds of a tracker at 50 Hz. Fewer: wider intervals.
/// Test: MaterialEstimate.ForgetsTheOldestSamples.
constexpr std::size_t touch_samples = 500;
/// Samples beyond the unknowns, at least. Fewer: no noise is seen. Test: MaterialEstimate.SaysNothingBeforeItCan.
constexpr int fewest_to_spare = 2;
/// Of the intervals. Test: MaterialEstimate.CoversTheTruthAsOftenAsItSays.
constexpr double confidence = 0.95;
/// Gauss–Newton iterations of a time constant; two or three are usual. Fewer: no reading of a strongly damped
/// touch. Test: MaterialEstimate.FindsTheDampingThatIsThere at 1.
constexpr int most_refits = 30;
/// Of the compliance of a touch: a material that yields less is rigid. Test:
/// Probe.WhatIsRigidReadsAsInfinite at 0.
constexpr double no_give = 1e-9;
/// Of its standard deviation: a change of the time constant that is none. Test: none: means nothing.
constexpr double settled = 1e-3;
/// [s] likewise, where there is no noise. More: a fit stops too early. Test:
/// MaterialEstimate.FindsTheDampingThatIsThere at 1.
constexpr double no_lag = 1e-9;

}  // namespace spring_workbench::instruments
