#pragma once

namespace spring_workbench::markers {

// Each with its unit, the effect of a change, and the test that detects it.

/// Minimum length of arrows of force and moment [m]; shorter ones are not drawn. Test: none: appearance.
constexpr double shortest_arrow = 1e-3;
/// Maximum length of arrows of force and moment [m]; longer ones are truncated. Test: none: appearance.
constexpr double longest_arrow = 1.0;
/// Distance between the hand and the proxy handle above which a line is drawn [m]. If smaller, it flickers with
/// rounding. Test: none: appearance.
constexpr double smallest_gap = 1e-5;
/// Minimum height above the bench of an object that casts a shadow [m]. If smaller, shadows of objects at rest flicker.
/// Test: MarkersOfALift.ARaisedBoxThrowsItsOwnOutlineOnTheBench.
constexpr double min_shadow_height = 2e-3;
/// Height of a shadow above the bench [m]. If smaller, the bench shows through. Test:
/// MarkersOfALift.ARaisedBoxThrowsItsOwnOutlineOnTheBench.
constexpr double shadow_above_bench = 1e-3;
/// Minimum lifetime of a marker in rviz [s]. If shorter, markers flicker if the node is late. Test:
/// rviz_recovery_test.py::test_markers.
constexpr double shortest_marker_lifetime = 2.0;
/// Opacity of the ghosts at the targets. Test: none: appearance.
constexpr double target_opacity = 0.25;
/// Number of corners of a circle's shadow. Test: none: appearance.
constexpr int outline_sides = 24;
/// Number of colours in the column of the legend. Test: MarkersOfALift.LoadIsColouredAndWrittenInVirtualKilograms.
constexpr int legend_steps = 16;
/// Size of one colour in the column of the legend [m]. Test: none: appearance.
constexpr double legend_edge = 0.018;
/// Height of the letters next to the column [m]. If larger, labels of similar weights are omitted. Test:
/// LoadScale.EveryWeightOfTheMiniWorldHasItsPosition.
constexpr double legend_letters = 0.018;

}  // namespace spring_workbench::markers
