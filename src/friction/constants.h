#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::friction {

/// Smallest part of the trace of a contact's response that counts as a response. Larger: contacts of nearly rigid
/// bodies get no load. Test: none: no value tried makes one fail.
constexpr double least_response = 1e-12;
/// Gauss–Seidel iterations between two checks of the residual. Fewer: all contacts are solved together although
/// iterations would do. Test: ContactProblem.AnEvenRowOfBoxesTakesIterationsAlone at 1.
constexpr int most_iterations = 10;
/// Ratio by which these iterations must reduce the residual for as many more to follow. Larger: iterations that hardly
/// converge are continued. Test: none: costs alone.
constexpr double worthwhile_reduction = 0.3;
/// Number of bodies above which factorising costs more than the finer residual is worth. Test: none: costs alone.
constexpr std::size_t many_bodies = 200;
/// Alternations for the finer residual, and for the one that is sufficient; alternations between two checks of the
/// residual, and between two changes of the penalty; depth of the Anderson acceleration. Fewer: Newton's method, which
/// factorises in each iteration, is needed more often. Test: ContactProblem.StacksOfUnlikeMassesTakeFewFactors at 0.
constexpr int most_alternations = 60, most_alternations_unsolved = 120, check_every = 5, penalty_every = 20,
              anderson_depth = 5;
/// Ratio of the primal to the dual residual above which the penalty is adapted; growth of an accelerated step above
/// which it is discarded. Larger: slower convergence. Test: ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at
/// 1e9.
constexpr double penalty_imbalance = 5.0, divergence_ratio = 1.5;
/// Penalty of Newton's method for contacts whose mean response is scaled to 1: initial value, growth from one set of
/// loads to the next, largest value; ratio of successive residuals above which a round counts as stalled. Test:
/// ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at 1e-9.
constexpr double first_penalty = 100.0, penalty_growth = 10.0, largest_penalty = 1e10, stalled_ratio = 0.99;
/// Sets of loads about which Newton's method linearises; successive stalled rounds after which the problem counts as
/// infeasible, as between walls that leave no room; iterations about each set; halvings of each iteration's step. Test:
/// ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at 0.
constexpr int most_rounds = 20, most_stalled_rounds = 8, most_newton_iterations = 20, most_halvings = 8;
/// Gauss–Seidel iterations for the friction of what bounces. Fewer: it takes less energy than it could. Test:
/// RigidWorld.ARodThatBouncesOnAnEdgeKeepsPoissonsLaw at 0.
constexpr int most_slides = 20;

}  // namespace spring_workbench::friction
