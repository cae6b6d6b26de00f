#include "spring_workbench/sound/contact_synthesizer.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::sound {

ContactSynthesizer::ContactSynthesizer(double volume) : volume_(volume) {
  validation::check_number("contact sound", "volume", volume, validation::between(0.0, 1.0));
}

ContactSynthesizer::Voice ContactSynthesizer::voice_of(const SoundingBody& body) {
  // Modes of a small wooden block: frequency [Hz], decay time to 1/e [s], relative amplitude.
  constexpr double ringing[4][3] = {
      {420.0, 0.060, 0.45}, {960.0, 0.035, 0.3}, {1730.0, 0.02, 0.15}, {3100.0, 0.01, 0.1}};
  const SoundingBody block;
  const double density = body.mass / std::pow(body.size, 3), of_block = block.mass / std::pow(block.size, 3);
  // Duration of the impact: half a period of the body on its contact spring.
  const double rigid_touch = M_PI * std::sqrt(body.mass / struck_stiffness);
  const double touch = rigid_touch * std::sqrt(1.0 + struck_stiffness * body.compliance);
  const auto gain = [](const double(&mode)[3], double frequency, double duration) {
    return mode[2] / (1.0 + std::pow(2.0 * frequency * duration, 2));
  };
  Voice voice{body, {}};
  double loudness = 0.0, loudness_if_rigid = 0.0;
  for (std::size_t i = 0; i < voice.modes.size(); ++i) {
    const double frequency = std::clamp(ringing[i][0] * block.size / body.size, lowest_pitch, highest_pitch);
    const double turn = 2.0 * M_PI * frequency / sample_rate;
    const double decay = std::exp(-1.0 / (ringing[i][1] * std::sqrt(density / of_block) * sample_rate));
    voice.modes[i] = {decay, std::cos(turn), std::sin(turn), gain(ringing[i], frequency, touch)};
    loudness += voice.modes[i].gain;
    loudness_if_rigid += gain(ringing[i], frequency, rigid_touch);
  }
  for (Mode& mode : voice.modes) mode.gain *= loudness_if_rigid / loudness;  // a soft one is duller, not softer
  return voice;
}

double ContactSynthesizer::Voice::loudness() const {
  double sum = 0.0;
  for (const Mode& mode : modes) sum += std::hypot(mode.x, mode.y);
  return sum;
}

ContactSynthesizer::Voice& ContactSynthesizer::find_voice(const SoundingBody& body) {
  const auto of_body = [&](const Voice& voice) { return voice.body == body; };
  const auto found = std::find_if(voices_.begin(), voices_.end(), of_body);
  if (found != voices_.end()) return *found;
  if (voices_.size() < max_voices) return voices_.emplace_back(voice_of(body));
  const auto softer = [](const Voice& a, const Voice& b) { return a.loudness() < b.loudness(); };
  return *std::min_element(voices_.begin(), voices_.end(), softer) = voice_of(body);
}

void ContactSynthesizer::strike(double impulse, const SoundingBody& body) {
  if (!(impulse > 0.0)) return;
  const double loudness = std::isfinite(impulse) ? impulse / (impulse + half_impulse) : 1.0;
  for (Mode& mode : find_voice(body).modes) mode.x = std::max(mode.x, mode.gain * loudness);
}

void ContactSynthesizer::scrape(double speed) { speed_ = std::isfinite(speed) ? std::max(speed, 0.0) : 0.0; }

std::vector<float> ContactSynthesizer::render(std::size_t count) {
  std::vector<float> samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double sum = volume_ * (ringing() + scraping());
    samples.push_back(static_cast<float>(std::clamp(sum, -1.0, 1.0)));
  }
  const auto silent = [](const Voice& voice) { return voice.loudness() < inaudible; };
  voices_.erase(std::remove_if(voices_.begin(), voices_.end(), silent), voices_.end());
  return samples;
}

double ContactSynthesizer::ringing() {
  double sum = 0.0;
  for (Voice& voice : voices_) {
    for (Mode& mode : voice.modes) {
      const double x = mode.decay * (mode.cosine * mode.x - mode.sine * mode.y);
      mode.y = mode.decay * (mode.sine * mode.x + mode.cosine * mode.y);
      mode.x = x;
      sum += mode.y;
    }
  }
  return sum;
}

double ContactSynthesizer::scraping() {
  heard_speed_ += (speed_ - heard_speed_) / (fade_time * sample_rate);
  noise_ = noise_ * 1664525u + 1013904223u;  // linear congruential generator from Numerical Recipes
  const double white = static_cast<double>(noise_ >> 8) / (1 << 23) - 1.0;
  const double loudness = heard_speed_ / (heard_speed_ + half_speed);
  const double frequency = 300.0 + 2500.0 * loudness;  // [Hz]
  const double f = 2.0 * std::sin(M_PI * frequency / sample_rate);
  low_ += f * band_;
  band_ += f * (white - low_ - band_);  // Chamberlin's state variable filter with Q = 1
  return scrape_gain * loudness * band_;
}

}  // namespace spring_workbench::sound
