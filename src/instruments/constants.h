#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::instruments {

/// Ratio of the heaviest object's weight to the lightest's above which the colours follow the logarithm of the load.
/// Test: LoadScale.EveryWeightOfTheMiniWorldHasItsPlace.
constexpr double one_decade = 10.0;
/// Fraction of the lightest object's weight at which logarithmic colours begin. More: the lightest object looks like no
/// load. Test: LoadScale.EveryWeightOfTheMiniWorldHasItsPlace.
constexpr double below_lightest = 0.5;
/// [s] length of the intervals whose means are averaged. Shorter: oscillations slower than this make the uncertainty
/// too small. Test: ReadingAverage.CoversTheTruthAsOftenAsItSays at 0.01.
constexpr double reading_part = 0.1;
/// Number of these intervals in an average. More: the reading reacts more slowly. Test:
/// ReadingAverage.IsOfTheLastSecond at 20.
constexpr std::size_t reading_parts = 10;
/// [N·s] impulse, in real units, of an impact that vibrates with full intensity. Less: weak impacts feel like strong
/// ones. Test: Vibration.AStrikeIsFeltInProportionInRealUnitsAndDiesAway.
constexpr double full_strike = 0.5;
/// [N/s] rate of the force that vibrates with full intensity. Less: it vibrates when a hand only moves. Test:
/// Vibration.AJoltIsTheRateOfTheForce.
constexpr double full_jolt = 2000.0;
/// [s] in which a vibration decays to 1/e. Longer: impacts blur into one. Test:
/// Vibration.AStrikeIsFeltInProportionInRealUnitsAndDiesAway.
constexpr double vibration_time = 0.05;
/// Intensity below which a vibration ends. More: weak impacts are not felt. Test:
/// Vibration.AStrikeIsFeltInProportionInRealUnitsAndDiesAway at 0.
constexpr double least_vibration = 0.02;

/// Samples of a touch from which the material is identified: ten seconds of a tracker at 50 Hz. Fewer: wider intervals.
/// Test: MaterialEstimate.ForgetsTheOldestSamples.
constexpr std::size_t touch_samples = 500;
/// Smallest number of samples beyond the number of unknowns. Fewer: the noise cannot be estimated. Test:
/// MaterialEstimate.SaysNothingBeforeItCan.
constexpr int fewest_to_spare = 2;
/// Confidence level of the intervals. Test: MaterialEstimate.CoversTheTruthAsOftenAsItSays.
constexpr double confidence = 0.95;
/// Largest number of Gauss–Newton iterations for the time constant; two or three are usual. Fewer: no reading of a
/// strongly damped touch. Test: MaterialEstimate.FindsTheDampingThatIsThere at 1.
constexpr int most_refits = 30;
/// Fraction of the compliance of a touch below which the material counts as rigid. Test:
/// Probe.WhatIsRigidReadsAsInfinite at 0.
constexpr double rigid_compliance = 1e-9;
/// Fraction of its standard deviation: a smaller change of the time constant ends the iteration. Test: none: means
/// nothing.
constexpr double converged_change = 1e-3;
/// [s] likewise, for data without noise. More: the fit ends too early. Test:
/// MaterialEstimate.FindsTheDampingThatIsThere at 1.
constexpr double no_lag = 1e-9;

}  // namespace spring_workbench::instruments
