#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::friction {

/// Share of the trace of a contact's response; what is less counts as none. Larger: contacts of what hardly gives way
/// get no load. Test: none: no value tried makes one fail.
constexpr double least_response = 1e-12;
/// Gauss–Seidel iterations. Fewer: all contacts are solved together where that is not worth it. Test:
/// ContactProblem.AnEvenRowOfBoxesTakesIterationsAlone at 1.
constexpr int most_iterations = 10;
/// Share of the residual that as many iterations may leave if as many more are to follow. Larger: iterations that
/// hardly converge are not given up. Test: none: costs alone.
constexpr double converging = 0.3;
/// Bodies in a problem in which a factor costs more than what the finer residual is worth. Test: none: costs alone.
constexpr std::size_t many_bodies = 200;
/// Alternations on the way to the finer residual, and to the one that is enough; alternations from one look at the
/// residual to the next, and from one change of the penalty to the next; alternations that the acceleration remembers.
/// Fewer: Newton's method, with a factor for each iteration, is needed more often. Test:
/// ContactProblem.StacksOfUnlikeMassesTakeFewFactors at 0.
constexpr int most_alternations = 60, most_alternations_in_need = 120, look_every = 5, weigh_every = 20, remembered = 5;
/// Ratio of what both directions still lack that the penalty may leave; growth of an accelerated step that is taken
/// back. Larger: slower. Test: ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at 1e9.
constexpr double out_of_balance = 5.0, astray = 1.5;
/// Penalty of Newton's method for contacts whose mean response is scaled to 1: the first, its growth from one set of
/// loads to the next, and the largest; share of the residual that counts as no progress. Test:
/// ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at 1e-9.
constexpr double first_penalty = 100.0, penalty_growth = 10.0, largest_penalty = 1e10, no_progress = 0.99;
/// Sets of loads about which Newton's method linearises; those in turn without progress, after which the problem is
/// taken for one without a solution, as between walls that leave no room; iterations about each, and halvings of one.
/// Test: ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at 0.
constexpr int most_rounds = 20, most_vain_rounds = 8, most_newton_iterations = 20, most_halvings = 8;

}  // namespace spring_workbench::friction
