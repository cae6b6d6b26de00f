#pragma once

namespace spring_workbench::tracker_driver {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Time for which a menu click holds the button for the next tool [s]. If shorter than a sample interval, it is missed.
/// Test: moved_by_messages_test.py::test_marker.
constexpr double menu_press = 0.1;
/// Maximum number of axes or buttons of a device. Test: JoySettings.BadValuesAreRefusedByName.
constexpr int max_controls = 64;
/// Largest deviation from 1 of a quaternion's norm. If larger, worse poses are sent. Test:
/// WhyNotSent.AnyPoseIsSentAndNothingElse.
constexpr double quaternion_tolerance = 0.1;
/// Tolerance for rounding of stamps [s]. If smaller, every other sample is dropped with ~rate. Test: none: no test
/// plays a motion with ~rate equal to its own rate.
constexpr double stamp_slack = 1e-6;
/// Maximum sleep between checks of other duties [s]. If longer, the node exits later and reports less often. Test:
/// none: the node only responds more slowly.
constexpr double longest_slice = 0.1;
/// Time between samples of a stylus that is moved by messages [s]. If longer, it moves in coarser steps. Test:
/// moved_by_messages_test.py::test_game_pad.
constexpr double message_interval = 1.0 / 60.0;

}  // namespace spring_workbench::tracker_driver
