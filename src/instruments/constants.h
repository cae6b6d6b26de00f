#pragma once

#include <cstddef>

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

namespace spring_workbench::instruments {

/// Ratio of the heaviest object's weight to the lightest's above which the colours follow the logarithm of the load.
/// Test: LoadScale.EveryWeightOfTheMiniWorldHasItsPosition.
constexpr double one_decade = 10.0;
/// Fraction of the lightest object's weight at which logarithmic colours begin. If larger, the lightest object is
/// coloured like no load. Test: LoadScale.EveryWeightOfTheMiniWorldHasItsPosition.
constexpr double below_lightest = 0.5;
/// Length of the intervals whose means are averaged [s]. If shorter, oscillations slower than this make the uncertainty
/// too small. Test: ReadingAverage.IntervalsHaveTheirNominalCoverage at 0.01.
constexpr double reading_part = 0.1;
/// Number of these intervals in an average. If more, the reading reacts more slowly. Test:
/// ReadingAverage.IsOfTheLastSecond at 20.
constexpr std::size_t reading_parts = 10;
/// Impulse of an impact that vibrates with full intensity [N·s], in real units. If smaller, weak impacts feel like
/// strong ones. Test: Vibration.AStrikeIsFeltInProportionInRealUnitsAndDiesAway.
constexpr double full_strike = 0.5;
/// Rate of the force that vibrates with full intensity [N/s]. If smaller, ordinary hand motion vibrates. Test:
/// Vibration.AJoltIsTheRateOfTheForce.
constexpr double full_jolt = 2000.0;
/// Time in which a vibration decays to 1/e [s]. If longer, impacts blur into one. Test:
/// Vibration.AStrikeIsFeltInProportionInRealUnitsAndDiesAway.
constexpr double vibration_time = 0.05;
/// Intensity below which a vibration ends. If larger, weak impacts are not felt. Test:
/// Vibration.AStrikeIsFeltInProportionInRealUnitsAndDiesAway at 0.
constexpr double min_vibration = 0.02;

/// Number of samples of a touch from which the material is identified: ten seconds at 50 Hz. If fewer, the confidence
/// intervals are wider. Test: MaterialEstimate.ForgetsTheOldestSamples.
constexpr std::size_t touch_samples = 500;
/// Minimum number of samples beyond the number of unknowns. If smaller, the noise cannot be estimated. Test:
/// MaterialEstimate.HasNoReadingBeforeEnoughData.
constexpr int min_extra_samples = 2;
/// Confidence level of the intervals. Test: MaterialEstimate.IntervalsHaveTheirNominalCoverage.
constexpr double confidence = 0.95;
/// Maximum number of Gauss–Newton iterations for the time constant; two or three are usual. If smaller, a strongly
/// damped touch gives no reading. Test: MaterialEstimate.FindsTheTrueDamping at 1.
constexpr int max_refits = 30;
/// Fraction of the compliance of a touch below which the material counts as rigid. Test:
/// Probe.ARigidBodyReadsAsInfinite at 0.
constexpr double rigid_compliance = 1e-9;
/// Change of the time constant at which the iteration ends, as a fraction of its standard deviation. Test: none: it has
/// no visible effect.
constexpr double converged_change = 1e-3;
/// The same for data without noise [s]. If larger, the fit ends too early. Test: MaterialEstimate.FindsTheTrueDamping
/// at 1.
constexpr double min_lag_change = 1e-9;

}  // namespace spring_workbench::instruments
