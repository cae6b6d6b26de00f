#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::stepping {

/// [1/s] What a method that keeps energy may err by in it, of what there is: 1 % in a minute. Test:
/// StableIntegrator.EveryCellStaysBoundedAndNoEnergyGrowsWithTheHandAtRest at 1.
constexpr double energy_share = 0.01 / 60.0;
/// [s]; so long steps may save of it for one that errs by more, and the shortest owe of it. Test:
/// StableIntegrator.EveryCellStaysBoundedAndNoEnergyGrowsWithTheHandAtRest at 100.
constexpr double most_saved = 0.1;
/// Of a span. Fewer: more steps are the fallback's. Test: UndampedFork.GainsNoEnergyWhileTheHandTremblesByANanometre at
/// 0.
constexpr int most_halvings = 6;
/// Times what a step's own error may differ by from its estimate, which a run adds up as if all did to one side. Test:
/// ErrorBound.IsNotBelowTheErrorOfRunsAndSteps at 0.1.
constexpr double local_margin = 4.0;
/// In the coordinates' own units; no state to go on from has more. Test: StepControl.TakesNoStepFromAStrainFarOff at
/// 1e300.
constexpr double most_strain = 1e100;
/// Of the next step's length, with a tolerance. Test: SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at
/// 0.1.
constexpr double safety = 0.8;
/// From one step to the next. Test: SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 1.
constexpr double most_growth = 3.0;
/// The same. Test: SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 1.
constexpr double least_growth = 0.1;
/// [s]; over this a rate that no spring stops becomes a strain. Test:
/// SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 1e-3.
constexpr double longest_swing = 1.0;
/// Of the span; a step shorter than two of these is taken whatever its error. Test:
/// SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 0.2.
constexpr double smallest_step = 1e-4;
/// [s]; the same where it is longer: substeps between contacts may be short. Test:
/// SteppedWithATolerance.LandsWithinAFactorOfThreeOfItsTolerance at 1e-2.
constexpr double shortest_step = 2e-6;
/// Of the range: where a strain that left it is put. Test:
/// StableIntegrator.AnObjectThatFallsOntoItsHandleStopsThereAndTurnsOn at 0.9.
constexpr double inside = 1.0 - 1e-9;
/// Over the length, for the range's slope. Test: StableIntegrator.AnObjectThatFallsOntoItsHandleStopsThereAndTurnsOn at
/// 1e-16.
constexpr double range_difference = 1e-6;
/// Of Newton's method to the range's end; the range is convex. Test:
/// StableIntegrator.AnObjectThatFallsOntoItsHandleStopsThereAndTurnsOn at 0.
constexpr int most_iterations = 20;
/// Of the way back to the begin, where that leads nowhere. Test: none: no value tried makes one fail.
constexpr int most_bisections = 50;
/// Of Newton's method for the strain under a force. Test: TwoHands.HandoverMovesTheObjectLessThanAMillimetre at 0.
constexpr int most_strain_iterations = 30;
/// Of one of its steps. Test: TwoHands.HandoverMovesTheObjectLessThanAMillimetre at 0.
constexpr int most_strain_halvings = 20;
/// Of the strain, for the slope of that force. Test: TwoHands.HandoverMovesTheObjectLessThanAMillimetre at 0.
constexpr double strain_difference = 1e-6;

}  // namespace spring_workbench::stepping
