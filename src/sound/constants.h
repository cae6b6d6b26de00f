#pragma once

#include <cstddef>

namespace spring_workbench::sound {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [N·s] heard half as loud as the loudest. Less: soft impacts are louder. Test:
/// ContactSynthesizer.HalfOfTheLoudestIsWhereItIsSaid.
constexpr double half_impulse = 0.2;
/// [m/s] likewise. Test: ContactSynthesizer.HalfOfTheLoudestIsWhereItIsSaid.
constexpr double half_speed = 0.2;
/// [N/m] of a contact, on which a body that is struck bounces. Larger: heavy bodies sound brighter. Test:
/// ContactSynthesizer.TheHeavierOfOneSizeIsTheDuller at 1e12.
constexpr double struck_stiffness = 1e7;
/// [Hz] the range of pitches: of what a loudspeaker plays. Narrower: bodies sound alike. Test:
/// ContactSynthesizer.TheLargerRingsTheLower at 900.
constexpr double lowest_pitch = 40.0;
/// [Hz] likewise. Test: ContactSynthesizer.TheLargerRingsTheLower at 500.
constexpr double highest_pitch = 16000.0;
/// Bodies that ring at a time. Fewer: soft ones end early. Test:
/// ContactSynthesizer.AThousandBodiesAreBoundedAndTheLoudestStay at 1.
constexpr std::size_t most_voices = 32;
/// Amplitude of a body that has rung out. Larger: it clicks. Test:
/// ContactSynthesizer.AnImpactIsLouderWithItsImpulseAndDiesAway at 0.1.
constexpr double inaudible = 1e-9;
/// of the loudest scrape beside the loudest impact. Test: ContactSynthesizer.TheLoudestScrapeHasTheLoudnessOfItsFilter.
constexpr double scrape_gain = 0.25;
/// [s] of a change of speed. Less: it clicks; more: a scrape outlives its slip. Test:
/// ContactSynthesizer.SlippingIsLouderAndHigherWithItsSpeedAndEnds.
constexpr double fade_time = 0.01;

}  // namespace spring_workbench::sound
