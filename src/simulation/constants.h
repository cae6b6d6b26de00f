#pragma once

#include <cstddef>

// The constants of the module: unit, what changing one does, and the test that notices.

namespace spring_workbench::simulation {

/// [s]; stamps nearer to each other are one. Smaller: a rounding error makes a step of its own.
/// `Simulation.ACallThatEndsARoundingErrorBesideASampleMakesNoStepOfItsOwn`
constexpr double same_time = 1e-9;
/// [s] for which a free body is slow before it sleeps. Larger: it costs longer. With contact mode `dynamic` 0.5 s: no
/// reason known. `Simulation.BoxThatIsDroppedComesToRestOnTheBench`
constexpr double asleep_after = 0.2;
/// [m]; what is nearer above an object that is taken lies on it, and wakes. Smaller: it may go on floating.
/// `Simulation.WhatLiesOnAGraspedObjectWakes`
constexpr double support_gap = 1e-4;
/// [m] from the origin; a body that flies further stops there. `Simulation.WhatFliesAwayStopsAtTheEndOfTheWorld`
constexpr double world_limit = 100.0;
/// [m] of a rigid tool, whose length means nothing but to be there. `Tools.DirectAndRayAreRigid`
constexpr double least_length = 1e-4;
/// [m] that the ray reaches. `Tools.DirectAndRayAreRigid`
constexpr double longest_ray = 2.0;
/// times as far as the present object another one must be to be taken instead. 1: a tip that trembles between two
/// changes all the time. `Overlapping.OneIsTakenAndTheOtherOnlyWhenItIsNearerByAFifth`
constexpr double another_is_nearer = 0.8;
/// hexadecimal digits of a word of a state's text. `State.RestoredAfterAnythingGivesTheSameFuture`
constexpr std::size_t word_digits = 16;

}  // namespace spring_workbench::simulation
