#pragma once

#include <cstddef>

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

namespace spring_workbench::math {

/// Cosine of half the angle between two directions below which the shortest rotation between them counts as undefined,
/// close to half a turn. Test: MovingFrames.AlignedRateIsTheDerivativeOfTheShortestTurn at 0.
constexpr double min_half_angle_cosine = 1e-6;
/// Hexadecimal digits per word in the text of a state. Test: State.RestoredAfterAnythingGivesTheSameFuture.
constexpr std::size_t word_digits = 16;

}  // namespace spring_workbench::math
