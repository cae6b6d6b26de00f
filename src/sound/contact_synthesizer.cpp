#include "spring_workbench/sound/contact_synthesizer.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::sound {

ContactSynthesizer::ContactSynthesizer(double volume) : volume_(volume) {
  validation::check_number("contact sound", "volume", volume, validation::between(0.0, 1.0));
  // A small wooden block: frequency [Hz], time to 1/e [s], share.
  constexpr double ringing[4][3] = {
      {420.0, 0.060, 0.45}, {960.0, 0.035, 0.3}, {1730.0, 0.02, 0.15}, {3100.0, 0.01, 0.1}};
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const double turn = 2.0 * M_PI * ringing[i][0] / sample_rate;
    const double decay = std::exp(-1.0 / (ringing[i][1] * sample_rate));
    modes_[i] = {decay, std::cos(turn), std::sin(turn), ringing[i][2]};
  }
}

void ContactSynthesizer::strike(double impulse) {
  if (!(impulse > 0.0)) return;
  const double loudness = std::isfinite(impulse) ? impulse / (impulse + half_impulse) : 1.0;
  for (Mode& mode : modes_) mode.x = std::max(mode.x, mode.gain * loudness);
}

void ContactSynthesizer::scrape(double speed) { speed_ = std::isfinite(speed) ? std::max(speed, 0.0) : 0.0; }

std::vector<float> ContactSynthesizer::render(std::size_t count) {
  std::vector<float> samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double sum = volume_ * (ringing() + scraping());
    samples.push_back(static_cast<float>(std::clamp(sum, -1.0, 1.0)));
  }
  return samples;
}

double ContactSynthesizer::ringing() {
  double sum = 0.0;
  for (Mode& mode : modes_) {
    const double x = mode.decay * (mode.cosine * mode.x - mode.sine * mode.y);
    mode.y = mode.decay * (mode.sine * mode.x + mode.cosine * mode.y);
    mode.x = std::abs(x) + std::abs(mode.y) > 1e-9 ? x : 0.0;  // no denormal numbers
    sum += mode.y;
  }
  return sum;
}

double ContactSynthesizer::scraping() {
  heard_speed_ += (speed_ - heard_speed_) / (fade_time * sample_rate);
  noise_ = noise_ * 1664525u + 1013904223u;  // Numerical Recipes' quick generator
  const double white = static_cast<double>(noise_ >> 8) / (1 << 23) - 1.0;
  const double loudness = heard_speed_ / (heard_speed_ + half_speed);
  const double frequency = 300.0 + 2500.0 * loudness;  // [Hz]
  const double f = 2.0 * std::sin(M_PI * frequency / sample_rate);
  low_ += f * band_;
  band_ += f * (white - low_ - band_);  // Chamberlin's filter with quality 1
  return scrape_gain * loudness * band_;
}

}  // namespace spring_workbench::sound
