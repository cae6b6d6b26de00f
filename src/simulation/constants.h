#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::simulation {

/// [m] length of a rigid tool, which has no effect but must be positive. Test: Tools.DirectAndRayAreRigid at 0.
constexpr double least_length = 1e-4;
/// [m] reach of the tool `ray`. Test: Tools.DirectAndRayAreRigid at 0.2.
constexpr double longest_ray = 2.0;
/// Ratio of distances below which another object replaces the highlighted one. 1: a trembling tip alternates between
/// two objects. Test: Overlapping.OneIsTakenAndTheOtherOnlyWhenItIsNearerByAFifth.
constexpr double another_is_nearer = 0.8;
/// Hexadecimal digits per word in the text of a state. Test: State.RestoredAfterAnythingGivesTheSameFuture.
constexpr std::size_t word_digits = 16;

}  // namespace spring_workbench::simulation
