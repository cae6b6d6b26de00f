#include "spring_workbench/sound/contact_synthesizer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::sound {
namespace {

constexpr std::size_t second = ContactSynthesizer::sample_rate;

double energy(const std::vector<float>& samples) {
  double sum = 0.0;
  for (const float s : samples) sum += static_cast<double>(s) * static_cast<double>(s);
  return sum;
}

double energy_of_strike(double impulse) {
  ContactSynthesizer synthesizer(1.0);
  synthesizer.strike(impulse);
  return energy(synthesizer.render(second));
}

std::vector<float> scraping(double speed) {
  ContactSynthesizer synthesizer(1.0);
  synthesizer.scrape(speed);
  synthesizer.render(second / 5);
  return synthesizer.render(second);
}

/// Changes of sign in a second.
int crossings(const std::vector<float>& samples) {
  int count = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) count += (samples[i - 1] < 0.0f) != (samples[i] < 0.0f);
  return count;
}

TEST(ContactSynthesizer, IsSilentUntilSomethingTouches) {
  EXPECT_EQ(energy(ContactSynthesizer(1.0).render(second)), 0.0);
}

TEST(ContactSynthesizer, AnImpactIsLouderWithItsImpulseAndDiesAway) {
  double last = 0.0;
  for (const double impulse : {1e-3, 1e-2, 0.1, 1.0, 10.0}) {
    const double now = energy_of_strike(impulse);
    EXPECT_GT(now, last) << impulse;
    last = now;
  }
  EXPECT_NEAR(energy_of_strike(2e-4) / energy_of_strike(1e-4), 4.0, 0.05);  // soft ones: in proportion
  ContactSynthesizer synthesizer(1.0);
  synthesizer.strike(1.0);
  const double first = energy(synthesizer.render(second));
  EXPECT_LT(energy(synthesizer.render(second)), 1e-10 * first);
}

TEST(ContactSynthesizer, SlippingIsLouderAndHigherWithItsSpeedAndEnds) {
  double last_energy = 0.0;
  int last_crossings = 0;
  for (const double speed : {0.01, 0.05, 0.2, 1.0}) {
    const std::vector<float> sound = scraping(speed);
    EXPECT_GT(energy(sound), last_energy) << speed;
    EXPECT_GT(crossings(sound), last_crossings) << speed;
    last_energy = energy(sound);
    last_crossings = crossings(sound);
  }
  ContactSynthesizer synthesizer(1.0);
  synthesizer.scrape(1.0);
  const double loud = energy(synthesizer.render(second));
  synthesizer.scrape(0.0);
  synthesizer.render(second / 5);
  EXPECT_LT(energy(synthesizer.render(second)), 1e-9 * loud);
}

/// Half of the amplitude at 0.2 N·s; at 0.2 m/s half of the loudness, and the pitch half way up.
TEST(ContactSynthesizer, HalfOfTheFullLoudnessIsAtItsConstant) {
  EXPECT_NEAR(energy_of_strike(0.2) / energy_of_strike(1e9), 0.25, 1e-6);
  const int half = crossings(scraping(0.2)), low = crossings(scraping(1e-4)), high = crossings(scraping(1e9));
  EXPECT_NEAR(half - low, 0.5 * (high - low), 0.1 * (high - low));
}

/// White noise of variance 1/3 through a band-pass filter of quality 1 at 2.8 kHz, of which a quarter is heard.
TEST(ContactSynthesizer, TheLoudestScrapeHasTheLoudnessOfItsFilter) {
  const double share_of_band = 0.5 * M_PI * 2800.0 / (0.5 * ContactSynthesizer::sample_rate);
  const double rms = std::sqrt(energy(scraping(1e9)) / static_cast<double>(second));
  EXPECT_NEAR(rms, 0.25 * std::sqrt(share_of_band / 3.0), 0.15 * rms);
}

TEST(ContactSynthesizer, SamplesAreBoundedWhateverComes) {
  ContactSynthesizer synthesizer(1.0);
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), -1.0, 1e300, 0.0, 0.3}) {
    synthesizer.strike(value);
    synthesizer.scrape(value);
    for (const float s : synthesizer.render(second / 10)) {
      ASSERT_GE(s, -1.0f);
      ASSERT_LE(s, 1.0f);
    }
  }
}

std::vector<float> struck(const SoundingBody& body) {
  ContactSynthesizer synthesizer(1.0);
  synthesizer.strike(0.3, body);
  return synthesizer.render(second);
}

/// Similar bodies of one material: frequencies go with one over the size, so that a sound is drawn out by it.
TEST(ContactSynthesizer, TheLargerRingsTheLower) {
  const auto first_crossing = [](const std::vector<float>& samples) {
    std::size_t i = 1;
    while ((samples[i - 1] < 0.0f) == (samples[i] < 0.0f)) ++i;
    return static_cast<double>(i);
  };
  int last = 1 << 30;
  for (const double size : {0.02, 0.06, 0.2, 0.6}) {
    const int now = crossings(struck({600.0 * std::pow(size, 3), size}));
    EXPECT_LT(now, last) << size;
    last = now;
  }
  // One mode decides in the end: 420 Hz of the block, 210 Hz of twice the size and the same weight.
  EXPECT_NEAR(first_crossing(struck({1e3, 0.12})) / first_crossing(struck({1e3, 0.06})), 2.0, 0.1);
}

/// Share of the sound's energy in its differences: of high pitches.
double brightness(const std::vector<float>& samples) {
  std::vector<float> differences;
  for (std::size_t i = 1; i < samples.size(); ++i) differences.push_back(samples[i] - samples[i - 1]);
  return energy(differences) / energy(samples);
}

TEST(ContactSynthesizer, TheHeavierOfOneSizeIsTheDuller) {
  double last = 1e9;
  for (const double mass : {0.01, 0.1, 1.0, 10.0}) {
    const double now = brightness(struck({mass, 0.06}));
    EXPECT_LT(now, last) << mass;
    last = now;
  }
}

/// In the end only the lowest mode is heard; a soft body is as loud as a rigid one.
TEST(ContactSynthesizer, TheSofterMaterialIsTheDuller) {
  const std::vector<float> rigid = struck({0.13, 0.06});
  double last = brightness(rigid);
  for (const double stiffness : {1e7, 1e6, 1e5, 1e4}) {
    const std::vector<float> soft = struck({0.13, 0.06, 1.0 / stiffness});
    EXPECT_LT(brightness(soft), last) << stiffness;
    last = brightness(soft);
    EXPECT_GT(energy(soft), energy(rigid)) << stiffness;
    EXPECT_LT(energy(soft), 2.0 * energy(rigid)) << stiffness;
  }
  EXPECT_LT(last, 0.7 * brightness(rigid));
}

/// Sixteen times the density: four times as long.
TEST(ContactSynthesizer, TheDenserMaterialRingsTheLonger) {
  /// [samples] in which it goes down to 1/e; begins late, when the lowest mode alone is heard.
  const auto time_constant = [](const std::vector<float>& samples, std::ptrdiff_t begin, std::ptrdiff_t length) {
    const auto at = samples.begin() + begin;
    const double before = energy({at, at + length}), after = energy({at + length, at + 2 * length});
    return static_cast<double>(length) / (0.5 * std::log(before / after));
  };
  const double wood = time_constant(struck({0.13, 0.06}), 8820, 2205),
               metal = time_constant(struck({2.08, 0.06}), 26460, 8820);
  EXPECT_NEAR(metal / wood, 4.0, 0.05);
}

TEST(ContactSynthesizer, AThousandBodiesAreBoundedAndTheLoudestStay) {
  ContactSynthesizer synthesizer(0.01), alone(0.01);
  synthesizer.strike(100.0, {1.0, 0.1});
  alone.strike(100.0, {1.0, 0.1});
  for (int i = 0; i < 1000; ++i) synthesizer.strike(1e-7, {0.1 + 1e-3 * i, 0.05});
  const std::vector<float> all = synthesizer.render(second), loudest = alone.render(second);
  for (std::size_t i = 0; i < all.size(); ++i) ASSERT_NEAR(all[i], loudest[i], 1e-6f);
}

TEST(ContactSynthesizer, VolumeScales) {
  ContactSynthesizer loud(0.8), soft(0.4), mute(0.0);
  for (ContactSynthesizer* s : {&loud, &soft, &mute}) {
    s->strike(0.1);
    s->scrape(0.3);
  }
  const std::vector<float> a = loud.render(second), b = soft.render(second);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], 2.0f * b[i], 1e-6f);
  EXPECT_EQ(energy(mute.render(second)), 0.0);
  EXPECT_THROW(ContactSynthesizer(1.1), validation::InputError);
  EXPECT_THROW(ContactSynthesizer(std::nan("")), validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::sound
