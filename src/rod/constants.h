#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::rod {

/// Number of quadrature nodes of a segment of a rod that is bent far, at compile time. Fewer: its tip is less exact.
/// Test: none: no other was tried.
constexpr int max_nodes = 8;
/// Largest angle by which a segment turns [rad]; tip and Jacobian are exact to 1e-10 up to it. Test:
/// Linear.SeveralAtOnceAreEachByItself at 20.
constexpr double angle_per_segment = 2.5;
/// Largest wave() for which six nodes are as exact. Larger: the tip of a bent rod is less exact. Test:
/// StrainRod.TheJacobianIsTheSlopeOfTheTipWithAnyNumberOfNodes at 3.2.
constexpr double wave_of_six = 1.6;
/// The same for five nodes. Test: StrainRod.TheJacobianIsTheSlopeOfTheTipWithAnyNumberOfNodes at 1.6.
constexpr double wave_of_five = 0.8;
/// Angle by which the largest strain winds the rod up [rad]; a rod that is wound up further is not admissible. Test:
/// StrainRod.WoundUpOrCrushedIsNotAdmissible at 1e6.
constexpr double max_turning = 64.0;
/// Fraction of the rest length; a rod that is compressed further is not admissible. Test:
/// Linear.ATipPushedThroughItsHandleStaysBehindAndComesBackAsItWent at 0.2.
constexpr double min_stretch = 0.02;
/// Largest rotation of the tip of a `bushing` [rad]: its coordinates are singular at a full turn. Test: none: no value
/// tried makes one fail.
constexpr double largest_angle = 6.0;

/// Steps of finite differences as fractions of strains or rates that are far off. Smaller: they are lost in rounding.
/// Test: StiffIntegrator.AStretchFarOffMovesAsOneLessFarOff at 0.
constexpr double resolved = 1e-10;

/// Static deformation: displacement of the tip for numerical derivatives, relative to its own. Test: none: no value
/// tried makes one fail.
constexpr double tip_difference = 1e-6;
/// The same as a fraction of a large strain. Test: none: no value tried makes one fail.
constexpr double strain_digits = 1e-8;
/// Displacement of the tip per strain that counts as such, in lengths of the rod. Test: none: no value tried makes one
/// fail.
constexpr double least_leverage = 1e-3;
/// Change of the tip, relative to its displacement, that is the last. Larger: the static deformation is less exact.
/// Test: Paper.NoHandNoForkAndNoStepMakesItRejectOne at 1e-2.
constexpr double settled = 1e-10;
/// Largest first change of the tip, relative to the length or in radians. Test: none: no value tried makes one fail.
constexpr double first_reach = 1.0;
/// Growth of this limit after a change that went as far as it. Test: Paper.NoHandNoForkAndNoStepMakesItRejectOne at 1.
constexpr double reach_growth = 4.0;
/// Fraction of a change that must be made for the limit not to shrink to it. Test: none: no value tried makes one fail.
constexpr double nearly_whole = 0.75;
/// Fraction of the force along a change that may remain, with opposite sign, at its end. Test: none: no value tried
/// makes one fail.
constexpr double overshoot = 0.5;
/// Largest number of changes; the residual is then reported. Test: none: no value tried makes one fail.
constexpr int max_changes = 60;
/// Largest number of halvings of a change. Test: HeldBody.HangingObjectSagsByItsWeightOverTheStiffness at 0.
constexpr int max_search_halvings = 40;
/// Halvings by which the end of the rod's range is found: the digits of a number. Test:
/// Paper.EndsAtTheEndOfTheRodsRange at 1.
constexpr int halvings_to_stop = 52;
/// Fraction of the largest stiffness below which a stiffness counts as none. Test: none: no value tried makes one fail.
constexpr double flat = 1e-12;

/// Fit of the tip to a pose: largest number of steps. Test: Linear.FindsTheStrainAndItsRateForTheTipsMotion at 1.
constexpr int max_iterations = 60;
/// Largest number of halvings of a step. Test: Linear.SeveralAtOnceAreEachByItself at 0.
constexpr int max_fit_halvings = 12;
/// Fraction of the remaining distance by which a step must be predicted to reduce it; otherwise the rod cannot get
/// closer to the pose. Test: Linear.SeveralAtOnceAreEachByItself at 0.5.
constexpr double min_progress = 1e-3;
/// Fraction of a change to which its part that ends at the limit of the range is found. Test:
/// Linear.ATipPushedThroughItsHandleStaysBehindAndComesBackAsItWent at 0.1.
constexpr double to_the_end = 1e-9;
/// Change of the last step, relative to the rod's length or in radians: Newton's method converges quadratically, so the
/// remaining error is below rounding. Test: Linear.FindsTheStrainAndItsRateForTheTipsMotion at 1e-3.
constexpr double last_change = 3e-8;
/// Largest step, relative to the rod's length or in radians. Test: none: no value tried makes one fail.
constexpr double farthest = 0.5;
/// Largest deviation of a change from the one that the Jacobian predicts, relative to it. Larger: another solution may
/// be found. Test: Linear.SeveralAtOnceAreEachByItself at 100.
constexpr double max_nonlinearity = 0.5;
/// Smallest singular value of the scaled Jacobian that counts as nonsingular: that of a straight rod compressed to the
/// end of its range (uncompressed: 0.1). In a direction with a smaller one, the tip is at the boundary of its
/// workspace. Test: Linear.FindsTheStrainAndItsRateForTheTipsMotion at 0.3.
constexpr double min_motion = 1e-3;

}  // namespace spring_workbench::rod
