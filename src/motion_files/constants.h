#pragma once

namespace spring_workbench::motion_files {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Largest time of a waypoint [s]. If larger, rounding exceeds the sample interval. Test:
/// ScriptedSource.BadScriptsNameFileLineFieldAndRule.
constexpr double farthest_script_time = 1e6;
/// Largest number of samples of a script. If larger, times in another unit use up all memory. Test:
/// ScriptedSource.BadScriptsNameFileLineFieldAndRule.
constexpr double most_samples = 1e7;
/// Resolution of ROS time [s]. If larger, a sample before the last waypoint is dropped. Test:
/// ScriptedSource.BadScriptsNameFileLineFieldAndRule.
constexpr double closest_samples = 1e-9;
/// Largest time that a PoseTrack accepts [s]. Test: limits_test.py::test_motions.
constexpr double farthest_time = 1e12;
/// Largest coordinate that a PoseTrack accepts [m]. Test: MotionFile.BadLinesNameFileLineFieldValueAndRule.
constexpr double farthest_position = 1e9;

}  // namespace spring_workbench::motion_files
