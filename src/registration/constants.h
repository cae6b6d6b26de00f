#pragma once

#include <cstddef>

namespace spring_workbench::registration {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Minimum RMS distance of the landmarks from a line [m]. If smaller, the rotation about that line is not determined.
/// Test: Registration.LandmarksThatDoNotDetermineThePoseAreRefused.
constexpr double min_extent = 0.01;
/// Largest number of landmarks for which every order is tried. If larger, it takes minutes; if smaller, a wrong order
/// passes. Test: Registration.EveryWrongOrderIsRefused.
constexpr int max_permuted = 7;
/// Minimum number of poses of the pivoting stylus. Test: PivotCalibration.TakesTenPosesAndNoFewer.
constexpr std::size_t min_poses = 10;
/// Minimum of the smallest singular value divided by the square root of the number of poses: about 20° about two axes.
/// If smaller, a poorly determined tip passes. Test: PivotCalibration.RefusesTooLittleTurningAndASlip.
constexpr double min_turning = 0.1;

}  // namespace spring_workbench::registration
