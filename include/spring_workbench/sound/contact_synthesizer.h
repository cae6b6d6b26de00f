#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace spring_workbench::sound {

/// What rings: a body as compact as a cube of edge `size` [m] and of `mass` [kg], both > 0.
struct SoundingBody {
  double mass = 0.13, size = 0.06;  ///< of a small wooden block

  bool operator==(const SoundingBody& other) const { return mass == other.mass && size == other.size; }
};

/// Turns contacts into sound: an impact is struck on a small set of ringing modes of a body, louder with its impulse;
/// slipping is noise that grows louder and higher with the speed. The larger a body, the lower it rings; the heavier,
/// the duller, since it touches for longer; the denser its material, the longer (doc/reference.md, contact_sound).
/// Samples lie in −1 … 1; the same calls give the same samples.
class ContactSynthesizer {
 public:
  static constexpr int sample_rate = 44100;  ///< [Hz]

  /// `volume` in 0 … 1. Throws InputError for another.
  explicit ContactSynthesizer(double volume);

  /// An impact of a normal impulse ≥ 0 [N·s] on a body. If too many bodies ring to be distinguished, the softest ends.
  void strike(double impulse, const SoundingBody& body = SoundingBody());
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
  struct Voice {
    SoundingBody body;
    std::array<Mode, 4> modes;

    double loudness() const;
  };
  static Voice voice_of(const SoundingBody& body);
  Voice& find_voice(const SoundingBody& body);
  std::vector<Voice> voices_;               ///< of what rings
  double speed_ = 0.0, heard_speed_ = 0.0;  ///< [m/s]; the second follows the first without a click
  double low_ = 0.0, band_ = 0.0;           ///< state of the noise's band-pass
  std::uint32_t noise_ = 1;
};

}  // namespace spring_workbench::sound
