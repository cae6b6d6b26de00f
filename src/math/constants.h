#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::math {

/// Of the interior point method, which takes some twenty. Test: FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre
/// at 10.
constexpr int most_iterations = 100;
/// Of the rates and impulses, both scaled to 1, to which the law is kept. Larger: less exact. Test:
/// FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre at 1.
constexpr double solved = 1e-11;
/// Likewise, where no iteration comes nearer; what is further off is refused. Test:
/// FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre at 1e-4.
constexpr double acceptable = 1e-6;
/// Of what is missing: the least distance from the cones that is aimed at. Smaller: it stalls at the cones' edges.
/// Test: FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre at 10.
constexpr double slip_share = 0.1;
/// Coefficient; a narrower cone is taken so wide. Test: FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre.
constexpr double least_friction = 1e-6;
/// Of that of the contact that gives way most: the scale of the others, at least. Test:
/// FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre at 1e-4.
constexpr double least_response = 1e-6;
/// Cosine of half the turn that is the shortest way; one nearer to a half turn is none. Test:
/// MovingFrames.AlignedRateIsTheDerivativeOfTheShortestTurn at 0.
constexpr double no_shortest_way = 1e-6;

}  // namespace spring_workbench::math
