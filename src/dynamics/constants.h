#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::dynamics {

/// Duration of the return of a DOF that is switched off, in time constants. Test: none: no value tried makes one fail.
constexpr double return_duration = 45.0;
/// [units] for the frozen part of `exponential`. Test: HeldBody.HangingObjectSagsByItsWeightOverTheStiffness at 1.
constexpr double frozen_difference = 1e-5;
/// [units] by strain, for implicit methods. Test: EveryIntegrator.HasItsOrderOfAccuracy at 1e-2, 1e-15.
constexpr double strain_difference = 3e-8;
/// [units/s] by rate, likewise; larger: short steps lose their order. Test: EveryIntegrator.HasItsOrderOfAccuracy at 1.
constexpr double rate_difference = 3e-7;
/// [steps] by time, likewise. Test: EveryIntegrator.HasItsOrderOfAccuracy at 0.5.
constexpr double time_difference = 1e-4;
/// Largest number of Newton iterations. Test: StiffIntegrator.AStretchFarOffMovesAsOneLessFarOff at 1.
constexpr int max_newton_steps = 10;
/// Last change of the rates, relative to all. Test: StiffIntegrator.AStretchFarOffMovesAsOneLessFarOff at 1e-3.
constexpr double newton_tolerance = 1e-13;
/// The same relative to the first, if it grows: of rounding. Test: none: no value tried makes one fail.
constexpr double newton_rounding = 1e-6;
/// Error of a step of `rosenbrock` to that of its halves: from 2⁴ − 1, if smooth, to 2 − 1, if stiff. Test:
/// EveryIntegrator.EstimatesItsLocalErrorWithinAFactorOfTenInNineStepsOfTen at 1e3.
constexpr double finer_by = 10.0;
/// Bisections of the path of a step of `paper` (its section 5). Test: Paper.SelectsTheFirstBodyInFront at 0.
constexpr int collision_halvings = 8;
/// Part of further iterations' change that the bound allows for. Test: none: no value tried makes one fail.
constexpr double fraction_of_iterations = 0.5;

}  // namespace spring_workbench::dynamics
