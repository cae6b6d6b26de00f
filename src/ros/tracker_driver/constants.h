#pragma once

namespace spring_workbench::tracker_driver {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] for which the menu holds the button for the next tool. Shorter than a sample: it is missed. Test:
/// moved_by_messages_test.py::test_marker.
constexpr double menu_press = 0.1;
/// axes or buttons of one device. Test: JoySettings.BadValuesAreRefusedByName.
constexpr int most_controls = 64;
/// how far a quaternion's length may be from 1. Larger: worse poses are sent. Test:
/// WhyNotSent.AnyPoseIsSentAndNothingElse.
constexpr double quaternion_tolerance = 0.1;
/// [s] rounding of stamps. Less: with ~rate every other sample is left out. Test: none: no test plays with ~rate at a
/// motion's own rate.
constexpr double stamp_slack = 1e-6;
/// [s] between looks at what else is due. Longer: the node ends later and reports less often. Test: none: the node's
/// answers get slower.
constexpr double longest_slice = 0.1;
/// [s] between samples of a stylus that messages move. Longer: it moves in coarser steps. Test:
/// moved_by_messages_test.py::test_game_pad.
constexpr double message_interval = 1.0 / 60.0;

}  // namespace spring_workbench::tracker_driver
