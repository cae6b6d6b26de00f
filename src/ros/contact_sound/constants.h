#pragma once

namespace spring_workbench::contact_sound {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Length of the blocks in which sound is rendered [s]. If longer, the delay after a contact is longer. Test: none: the
/// file has the same sound.
constexpr double render_period = 0.02;
/// Maximum gap that is filled after the process was stopped [s]. If longer, the burst is longer. Test: none: it only
/// matters after the process was stopped.
constexpr double longest_filled_gap = 0.5;
/// Time without a message after which scraping ends [s]. If longer, a scrape outlasts its node. Test:
/// contact_sound_test.py::test_an_impact_and_a_scrape_are_in_the_file.
constexpr double silent_after = 0.3;

}  // namespace spring_workbench::contact_sound
