#pragma once

namespace spring_workbench::markers {

// Each with its unit, what changing it does, and the test that notices.

/// [m] arrows of force and moment below it are not drawn. Test: none: a look.
constexpr double shortest_arrow = 1e-3;
/// [m] arrows of force and moment are cut to it. Test: none: a look.
constexpr double longest_arrow = 1.0;
/// [m] between the hand and the proxy handle above which a line is drawn. Less: it flickers with rounding. Test: none:
/// a look.
constexpr double smallest_gap = 1e-5;
/// [m] above the bench from which on an object throws a shadow. Less: those at rest flicker. Test:
/// MarkersOfALift.ARaisedBoxThrowsItsOwnOutlineOnTheBench.
constexpr double least_shadow_height = 2e-3;
/// [m] less: the bench shines through. Test: MarkersOfALift.ARaisedBoxThrowsItsOwnOutlineOnTheBench.
constexpr double shadow_above_bench = 1e-3;
/// [s] for which rviz keeps a marker that is not sent again, at least. Shorter: flickers when the node is late. Test:
/// rviz_recovery_test.py::test_markers.
constexpr double shortest_marker_lifetime = 2.0;
/// of the ghosts where objects belong. Test: none: a look.
constexpr double target_opacity = 0.25;
/// corners of a circle's shadow. Test: none: a look.
constexpr int outline_sides = 24;
/// colours in the column of loads. Test: MarkersOfALift.LoadIsColouredAndToldInVirtualKilograms.
constexpr int legend_steps = 16;
/// [m] of one colour in the column of loads. Test: none: a look.
constexpr double legend_edge = 0.014;
/// [m] height of the letters beside the column of loads. Larger: marks of like weights are left out. Test:
/// LoadScale.EveryWeightOfTheMiniWorldHasItsPlace.
constexpr double legend_letters = 0.018;

}  // namespace spring_workbench::markers
