#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace spring_workbench::sound {

/// Turns contacts into sound: an impact is struck on a small set of ringing modes, louder with its impulse; slipping is
/// noise that grows louder and higher with the speed. Samples lie in −1 … 1; the same calls give the same samples.
class ContactSynthesizer {
 public:
  static constexpr int sample_rate = 44100;  ///< [Hz]

  /// `volume` in 0 … 1. Throws InputError for another.
  explicit ContactSynthesizer(double volume);

  /// An impact of a normal impulse ≥ 0 [N·s].
  void strike(double impulse);
  /// From now on, contacts slip at most at this speed ≥ 0 [m/s]; 0 ends it.
  void scrape(double speed);
  /// The next `count` samples, mono.
  std::vector<float> render(std::size_t count);

 private:
  /// A decaying oscillation as a rotating pointer.
  struct Mode {
    double decay = 0.0, cosine = 0.0, sine = 0.0;  ///< per sample
    double gain = 0.0;
    double x = 0.0, y = 0.0;
  };

  double ringing();
  double scraping();

  double volume_;
  std::array<Mode, 4> modes_;
  double speed_ = 0.0, heard_speed_ = 0.0;  ///< [m/s]; the second follows the first without a click
  double low_ = 0.0, band_ = 0.0;           ///< state of the noise's band-pass
  std::uint32_t noise_ = 1;
};

}  // namespace spring_workbench::sound
