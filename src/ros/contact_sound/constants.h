#pragma once

namespace spring_workbench::contact_sound {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [s] length of the blocks in which sound is rendered. Longer: sound comes later after the contact. Test: none: the
/// file has the same sound.
constexpr double render_period = 0.02;
/// [s] of sound that is made up for after the process stood still. Longer: a longer burst. Test: none: only a stopped
/// process meets it.
constexpr double longest_filled_gap = 0.5;
/// [s] without a message until nothing slips any more. Longer: a scrape outlives its node. Test:
/// contact_sound_test.py::test_an_impact_and_a_scrape_are_in_the_file.
constexpr double silent_after = 0.3;

}  // namespace spring_workbench::contact_sound
