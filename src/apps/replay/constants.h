#pragma once

namespace spring_workbench::replay {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] an output time this much after the motion's end is still given. Less: rounding takes the last line. Test:
/// Replay.WritesALinePerOutputTimeAndObject.
constexpr double time_tolerance = 1e-9;
/// [m] what a PoseTrack takes. Test: limits_test.py::test_bags.
constexpr double farthest_position = 1e9;

}  // namespace spring_workbench::replay
