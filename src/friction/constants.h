#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::friction {

/// Smallest part of the trace of a contact's response that counts as a response. Larger: contacts of nearly rigid
/// bodies get no load. Test: none: no value tried makes one fail.
constexpr double min_response = 1e-12;
/// Largest residual that is sufficient, as a fraction of the largest motion without loads. Larger: loads are as much
/// less exact where bodies hardly move, as in a short step. Test: ContactProblem.StacksOfUnlikeMassesTakeFewFactors at
/// 1e-6.
constexpr double sufficient_share = 0.01;
/// Gauss–Seidel iterations between two checks of the residual. Fewer: all contacts are solved together although
/// iterations would do. Test: ContactProblem.AnEvenRowOfBoxesTakesIterationsAlone at 1.
constexpr int check_iterations = 10;
/// Ratio by which these iterations must reduce the residual for as many more to follow, and by which loads that do not
/// solve the problem must reduce it to be taken. Larger: iterations that hardly converge are continued, and infeasible
/// problems get large loads. Test: ContactProblem.WallsThatLeaveNoRoomAreNotPressedApart at 1.
constexpr double worthwhile_reduction = 0.3;
/// Number of bodies above which the finer residual costs more than it is worth. Larger: piles are slower; smaller: a
/// stack of ten unlike masses creeps. Test: none: at 8 `contact_trials stack` fails, which takes minutes.
constexpr std::size_t max_bodies_finely = 16;
/// Largest number of alternations for the finer residual. Fewer: stopped bodies are blocked. Test:
/// Compliant.RestsAtItsWeightTimesTheComplianceWhateverItsShape at 0.
constexpr int max_fine_alternations = 60;
/// Largest number of alternations. Fewer: Newton's method, which factorises in each iteration, is needed more often.
/// Test: ContactProblem.StacksOfUnlikeMassesTakeFewFactors at 0.
constexpr int max_alternations = 300;
/// Alternations between two checks of the residual. Test: ContactProblem.StacksOfUnlikeMassesTakeFewFactors at 100.
constexpr int check_every = 5;
/// Alternations between two changes of the penalty. Test: ContactProblem.StacksOfUnlikeMassesTakeFewFactors at 1000.
constexpr int penalty_every = 20;
/// Depth of the Anderson acceleration. Test: ContactProblem.StacksOfUnlikeMassesTakeFewFactors at 1.
constexpr int anderson_depth = 5;
/// Ratio of the primal to the dual residual above which the penalty is adapted. Larger: slower convergence. Test:
/// none: no value tried makes one fail.
constexpr double penalty_imbalance = 5.0;
/// Growth of an accelerated step above which it is discarded. Test:
/// ContactProblem.AHeavyCubeOnALightOneSharesItsWeightOut at 0.1.
constexpr double divergence_ratio = 1.5;
/// First penalty of Newton's method, for contacts whose mean response is scaled to 1. Test:
/// ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at 1e-9.
constexpr double initial_penalty = 100.0;
/// Its growth from one set of loads to the next. Test: ContactProblem.RandomContactsKeepCoulombsLaw at 1.
constexpr double penalty_growth = 10.0;
/// Its largest value. Test: ContactProblem.RandomContactsKeepCoulombsLaw at 100.
constexpr double max_penalty = 1e10;
/// Sets of loads about which Newton's method linearises. Test: ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre
/// at 0.
constexpr int max_rounds = 20;
/// Ratio of successive residuals above which a set counts as stalled. Test:
/// ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at 0.
constexpr double stalled_ratio = 0.99;
/// Successive stalled sets after which the problem counts as infeasible, as between walls that leave no
/// room. Test: ContactProblem.RandomContactsKeepCoulombsLaw at 1.
constexpr int max_stalled_rounds = 8;
/// Iterations about each set in which the residual does not fall. Test: ContactProblem.RandomContactsKeepCoulombsLaw at
/// 1.
constexpr int max_newton_iterations = 20;
/// Halvings of each iteration's step. Test: ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at 0.
constexpr int max_halvings = 8;
/// Share of the residual that a step of Newton's method must take away, for the step to be taken whole, and for the
/// iteration not to count. Larger: shorter steps, and fewer of them. Test:
/// ContactProblem.KeepsCoulombsLawHoweverUnlikeTheMassesAre at 1.
constexpr double sufficient_decrease = 0.1;
/// Cosine of the angle within which the normals of two contacts are on one side of a body, so that they indent one
/// surface. At most 0, a body that is squeezed from two sides meets a rigid one. Test:
/// Surfaces.ABodySqueezedFromTwoSidesIndentsBoth at -2.
constexpr double same_side = 0.5;
/// Gauss–Seidel iterations for the friction of what bounces. Fewer: it takes less energy than it could. Test:
/// RigidWorld.ARodThatBouncesOnAnEdgeKeepsPoissonsLaw at 0.
constexpr int bounce_iterations = 20;
/// [m] by which a free body may be deeper after a step with its mean velocity than after one with its end velocity.
/// Larger: bodies sink in. Test: LooseThrows.AmongOthersNothingGoesDeepOrGainsEnergy at 1e-4.
constexpr double as_deep = 1e-7;
/// Share of the largest friction by which that of a contact that sticks is smaller. Larger: what has just come to rest
/// counts as sliding. Test: MeanVelocity.WhatBeginsToStickMovesWithItsEndVelocity at 0.9.
constexpr double slip_share = 1e-6;

}  // namespace spring_workbench::friction
