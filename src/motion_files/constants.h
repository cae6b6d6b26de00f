#pragma once

namespace spring_workbench::motion_files {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] of a waypoint. More: samples closer than their rounding. Test:
/// ScriptedSource.BadScriptsNameFileLineFieldAndRule.
constexpr double farthest_script_time = 1e6;
/// [s] what ROS time resolves. More: a sample before the last waypoint is left out. Test:
/// ScriptedSource.BadScriptsNameFileLineFieldAndRule.
constexpr double closest_samples = 1e-9;
/// [s] times of day that a PoseTrack takes. Test: limits_test.py::test_motions.
constexpr double farthest_time = 1e12;
/// [m] places that a PoseTrack takes. Test: MotionFile.BadLinesNameFileLineFieldValueAndRule.
constexpr double farthest_position = 1e9;

}  // namespace spring_workbench::motion_files
