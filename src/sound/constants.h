#pragma once

#include <cstddef>

namespace spring_workbench::sound {

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

/// Impulse that sounds half as loud as the loudest [N·s]. If smaller, soft impacts are louder. Test:
/// ContactSynthesizer.HalfOfTheFullLoudnessIsAtItsConstant.
constexpr double half_impulse = 0.2;
/// The same for slip speed [m/s]. Test: ContactSynthesizer.HalfOfTheFullLoudnessIsAtItsConstant.
constexpr double half_speed = 0.2;
/// Contact stiffness [N/m], which determines the duration of an impact. If larger, heavy bodies sound brighter. Test:
/// ContactSynthesizer.TheHeavierOfOneSizeIsTheDuller at 1e12.
constexpr double struck_stiffness = 1e7;
/// Lower end of the range of pitches [Hz]: what loudspeakers can play. If the range is narrower, bodies sound alike.
/// Test: ContactSynthesizer.TheLargerRingsTheLower at 900.
constexpr double lowest_pitch = 40.0;
/// Upper end of the range [Hz]. Test: ContactSynthesizer.TheLargerRingsTheLower at 500.
constexpr double highest_pitch = 16000.0;
/// Maximum number of bodies that ring at the same time. If smaller, quiet ones are cut off. Test:
/// ContactSynthesizer.AThousandBodiesAreBoundedAndTheLoudestStay at 1.
constexpr std::size_t max_voices = 32;
/// Amplitude of a body that has rung out. If larger, it clicks. Test:
/// ContactSynthesizer.AnImpactIsLouderWithItsImpulseAndDiesAway at 0.1.
constexpr double inaudible = 1e-9;
/// Amplitude of the loudest scrape relative to the loudest impact. Test:
/// ContactSynthesizer.TheLoudestScrapeHasTheLoudnessOfItsFilter.
constexpr double scrape_gain = 0.25;
/// Fade time of a change of speed [s]. If shorter, it clicks; if longer, a scrape outlasts its slip. Test:
/// ContactSynthesizer.SlippingIsLouderAndHigherWithItsSpeedAndEnds.
constexpr double fade_time = 0.01;

}  // namespace spring_workbench::sound
