#pragma once

// The constants of the module: unit, what changing one does, and the test that notices: "noticed by" was seen to fail
// with another value, "goes into" is by reading alone.

namespace spring_workbench::math {

/// Of the interior point method, which takes some twenty. Noticed by
/// `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`.
constexpr int most_iterations = 100;
/// Of the rates and impulses, both scaled to 1, to which the law is kept. Larger: less exact. Goes into
/// `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`.
constexpr double solved = 1e-11;
/// Likewise, where no iteration comes nearer; what is further off is refused. Noticed by
/// `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`.
constexpr double acceptable = 1e-6;
/// Of what is missing: the least distance from the cones that is aimed at. Smaller: it stalls at the cones' edges.
/// Noticed by `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`.
constexpr double slip_share = 0.1;
/// Coefficient; a narrower cone is taken so wide. Noticed by
/// `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`.
constexpr double least_friction = 1e-6;
/// Of that of the contact that gives way most: the scale of the others, at least. Noticed by
/// `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`.
constexpr double least_response = 1e-6;

}  // namespace spring_workbench::math
