#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::simulation {

/// [m] of a rigid tool, whose length means nothing but to be there. Test: Tools.DirectAndRayAreRigid at 0.
constexpr double least_length = 1e-4;
/// [m] that the ray reaches. Test: Tools.DirectAndRayAreRigid at 0.2.
constexpr double longest_ray = 2.0;
/// Times as far as the present object another one must be to be taken instead. 1: a tip that trembles between two
/// changes all the time. Test: Overlapping.OneIsTakenAndTheOtherOnlyWhenItIsNearerByAFifth.
constexpr double another_is_nearer = 0.8;
/// Hexadecimal digits of a word of a state's text. Test: State.RestoredAfterAnythingGivesTheSameFuture.
constexpr std::size_t word_digits = 16;

}  // namespace spring_workbench::simulation
