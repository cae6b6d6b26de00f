#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::math {

/// Largest number of iterations of the interior point method, which needs some twenty. Test:
/// FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre at 10.
constexpr int max_iterations = 100;
/// Residual of the law, with rates and impulses scaled to 1, at which the iteration ends. Larger: less exact. Test:
/// FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre at 1.
constexpr double residual_tolerance = 1e-11;
/// Largest residual of a solution that is returned although the iteration stopped before residual_tolerance. Test:
/// FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre at 1e-4.
constexpr double acceptable_residual = 1e-6;
/// Smallest centring, as a fraction of the residual. Smaller: the iteration stalls at the boundary of the cones. Test:
/// FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre at 10.
constexpr double min_centring = 0.1;
/// Smallest friction coefficient; a narrower cone is widened to it. Test:
/// FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre.
constexpr double min_friction = 1e-6;
/// Smallest response of a contact relative to the largest one, for the scaling of the problem. Test:
/// FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre at 1e-4.
constexpr double min_response = 1e-6;
/// Cosine of half the angle between two directions below which the shortest rotation between them counts as undefined,
/// close to half a turn. Test: MovingFrames.AlignedRateIsTheDerivativeOfTheShortestTurn at 0.
constexpr double min_half_angle_cosine = 1e-6;

}  // namespace spring_workbench::math
