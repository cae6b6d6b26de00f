#pragma once

namespace spring_workbench::sound {

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

/// [N·s] heard half as loud as the loudest. Less: soft impacts are louder. Test:
/// ContactSynthesizer.HalfOfTheLoudestIsWhereItIsSaid.
constexpr double half_impulse = 0.2;
/// [m/s] likewise. Test: ContactSynthesizer.HalfOfTheLoudestIsWhereItIsSaid.
constexpr double half_speed = 0.2;
/// of the loudest scrape beside the loudest impact. Test: ContactSynthesizer.TheLoudestScrapeHasTheLoudnessOfItsFilter.
constexpr double scrape_gain = 0.25;
/// [s] of a change of speed. Less: it clicks; more: a scrape outlives its slip. Test:
/// ContactSynthesizer.SlippingIsLouderAndHigherWithItsSpeedAndEnds.
constexpr double fade_time = 0.01;

}  // namespace spring_workbench::sound
