#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::stepping {

/// [1/s] relative energy error that a method which conserves energy may make: 1 % in a minute. Test:
/// StableIntegrator.EveryCellStaysBoundedAndNoEnergyGrowsWithTheHandAtRest at 1.
constexpr double energy_drift_rate = 0.01 / 60.0;
/// [s] of that allowance that long steps may save for later ones, and that the shortest ones may use in advance. Test:
/// StableIntegrator.EveryCellStaysBoundedAndNoEnergyGrowsWithTheHandAtRest at 100.
constexpr double energy_reserve = 0.1;
/// Largest number of halvings of a span. Fewer: more steps are taken by the fallback. Test:
/// UndampedFork.GainsNoEnergyWhileTheHandTremblesByANanometre at 0.
constexpr int most_halvings = 6;
/// Safety factor on the difference between the error of a step and its estimate; a run adds up these differences as if
/// all had one sign. Test: ErrorBound.IsNotBelowTheErrorOfRunsAndSteps at 0.1.
constexpr double local_margin = 4.0;
/// In the unit of each coordinate; a state with a larger strain or rate is rejected, before squares overflow. Test:
/// StepControl.TakesNoStepFromAStrainFarOff at 1e300.
constexpr double most_strain = 1e100;
/// Safety factor of the length of the next step, with a tolerance. Test:
/// SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 0.1.
constexpr double safety = 0.8;
/// Fraction by which a step may exceed that length if fewer steps then reach the end of the span. Test:
/// StepControl.AToleranceTakesLittleMoreThanFixedStepsOfTheSameError at 5.
constexpr double stretch = 0.05;
/// Largest ratio of successive steps. Test: SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 1.
constexpr double most_growth = 3.0;
/// Smallest ratio of successive steps. Test: SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 1.
constexpr double least_growth = 0.1;
/// [s] over which the error of a rate that no spring limits becomes an error of the strain. Test:
/// SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 1e-3.
constexpr double longest_swing = 1.0;
/// Fraction of the span; a step shorter than two of these is accepted whatever its error. Test:
/// SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 0.2.
constexpr double smallest_step = 1e-4;
/// [s] likewise, if this is longer: substeps between contacts may be short. Test:
/// SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 1e-2.
constexpr double shortest_step = 2e-6;
/// Largest number of halvings of the path of a fallback step. Test:
/// StableIntegrator.EveryCellStaysBoundedAndNoEnergyGrowsWithTheHandAtRest at 0.
constexpr int most_path_halvings = 20;
/// Fraction of the rod's range to which a strain beyond the range is moved back. Test:
/// StableIntegrator.AnObjectThatFallsOntoItsHandleStopsThereAndTurnsOn at 0.9.
constexpr double inside = 1.0 - 1e-9;
/// Step of the finite difference, in units of the coordinate, for the gradient of the range. Test:
/// StableIntegrator.AnObjectThatFallsOntoItsHandleStopsThereAndTurnsOn at 1e-16.
constexpr double range_difference = 1e-6;
/// Largest number of Newton iterations to the end of the range, which is convex. Test:
/// StableIntegrator.AnObjectThatFallsOntoItsHandleStopsThereAndTurnsOn at 0.
constexpr int most_iterations = 20;
/// Largest number of bisections back to the initial strain if Newton's method fails or the energy does not reach as
/// far. Test: none: no value tried makes one fail.
constexpr int most_bisections = 50;
/// Fraction of the force at no strain and at the start to which the search for a strain aims to reduce it. Test:
/// FindStrain.FindsTheStrainOfAnyForceThatTheSpringsExert at 1e-3.
constexpr double strain_accuracy = 1e-12;
/// The same fraction up to which the strain counts as found. Test: FindStrain.SaysWhereThereIsNone at 1e3.
constexpr double max_strain_error = 1e-6;
/// Largest number of Newton iterations for the strain under a force. Test:
/// TwoHands.HandoverMovesTheObjectLessThanAMillimetre at 0.
constexpr int most_strain_iterations = 30;
/// Largest number of halvings of one of these iterations. Test: TwoHands.HandoverMovesTheObjectLessThanAMillimetre at
/// 0.
constexpr int most_strain_halvings = 20;
/// Step of the finite difference, in units of the coordinate, for the gradient of that force. Test:
/// TwoHands.HandoverMovesTheObjectLessThanAMillimetre at 0.
constexpr double strain_difference = 1e-6;

}  // namespace spring_workbench::stepping
