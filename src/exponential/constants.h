#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::exponential {

/// Largest norm of an element of the matrix that separates invariant subspaces. A larger one leaves fewer clusters and
/// costs digits, in proportion. Test: RealModes.AreWellConditionedHoweverCloseTheRates at 1e3.
constexpr double largest_element = 10.0;
/// Coupling relative to the norm of the matrix that counts as none: its rounding error. Larger: less exact. Smaller: a
/// few more oscillators that are alike form a cluster (at 0, 12 of 500 pairs seen from random axes in place of 11).
/// Test: RealModes.MakeTheMatrixAgain at 1e-3.
constexpr double negligible_coupling = 1e-15;
/// Iterations per rate within which the Schur form is found. Some ten are usual, but four equal rates with one
/// eigenvector take over a hundred. Test: RealModes.AreWellConditionedHoweverCloseTheRates at 40.
constexpr int most_iterations = 1000;

}  // namespace spring_workbench::exponential
