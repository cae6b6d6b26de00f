#pragma once

// The constants of the module: unit, what changing one does, and the test that notices.

namespace spring_workbench::math {

/// of the interior point method, which takes some twenty. `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`
constexpr int most_iterations = 100;
/// of the rates and impulses, both scaled to 1, to which the law is kept. Larger: less exact.
/// `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`
constexpr double solved = 1e-11;
/// likewise, where no iteration comes nearer; what is further off is refused.
/// `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`
constexpr double acceptable = 1e-6;
/// of what is missing: the least distance from the cones that is aimed at. Smaller: it stalls at the cones' edges.
/// `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`
constexpr double slip_share = 0.1;
/// coefficient; a narrower cone is taken so wide. `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`
constexpr double least_friction = 1e-6;
/// of that of the contact that gives way most: the scale of the others, at least.
/// `FrictionCones.KeepCoulombsLawHoweverUnlikeTheMassesAre`
constexpr double least_response = 1e-6;

}  // namespace spring_workbench::math
