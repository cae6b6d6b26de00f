#pragma once

#include <cstddef>

namespace spring_workbench::registration {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [m] RMS distance of the landmarks from a line. Less: the turn about that line is a guess. Test:
/// Registration.WhatCannotTellThePoseIsRefused.
constexpr double least_extent = 0.01;
/// landmarks of which every order is tried. More: minutes; fewer: a wrong order passes. Test:
/// Registration.EveryWrongOrderIsRefused.
constexpr int most_permuted = 7;
/// of the stylus that is turned about its tip. Test: PivotCalibration.TakesTenPosesAndNoFewer.
constexpr std::size_t fewest_poses = 10;
/// smallest singular value per root of the count: about 20° about two axes. Less: a guessed tip passes. Test:
/// PivotCalibration.RefusesTooLittleTurningAndASlip.
constexpr double least_turned = 0.1;

}  // namespace spring_workbench::registration
