#pragma once

namespace spring_workbench::replay {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Time by which an output time may exceed the end of the motion [s]. If smaller, rounding drops the last row. Test:
/// Replay.WritesALinePerOutputTimeAndObject.
constexpr double time_tolerance = 1e-9;
/// Largest number of output times of recorded hands. If larger, stamps in milliseconds fill the disk before an error is
/// noticed. Test: Replay.StampsInAnotherUnitAreRefused.
constexpr double most_outputs = 1e7;
/// Steps per step of another rule from which on there is a warning: one in a hundred. If larger, it is given where
/// nothing is wrong; if smaller, a result may come mostly from that rule unnoticed. Test:
/// Replay.WarnsWhenTheIntegratorDidNotTakeTheSteps.
constexpr double fallback_share = 100.0;
/// Largest coordinate that a PoseTrack accepts [m]. Test: limits_test.py::test_bags.
constexpr double farthest_position = 1e9;

}  // namespace spring_workbench::replay
