#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace spring_workbench::sound {

/// A ringing body: as compact as a cube of edge `size` [m] and with `mass` [kg], both > 0.
struct SoundingBody {
  double mass = 0.13, size = 0.06;  ///< defaults: a small wooden block
  double compliance = 0.0;          ///< compliance of both bodies' materials at the contact, ≥ 0 [m/N]

  bool operator==(const SoundingBody& other) const {
    return mass == other.mass && size == other.size && compliance == other.compliance;
  }
};

/// Turns contacts into sound. An impact excites a few ringing modes of a body, louder for a larger impulse; slipping is
/// noise that gets louder and higher with speed. A larger body rings lower; a heavier one and a softer one sound
/// duller, since they stay in contact for longer; one of a denser material rings for longer (doc/reference.md,
/// contact_sound). Samples are in −1 … 1; the same calls give the same samples.
class ContactSynthesizer {
 public:
  static constexpr int sample_rate = 44100;  ///< [Hz]

  /// `volume`: 0 … 1. Throws InputError otherwise.
  explicit ContactSynthesizer(double volume);

  /// Adds an impact with this normal impulse ≥ 0 [N·s] on a body. If too many bodies are ringing, the quietest one is
  /// cut off.
  void strike(double impulse, const SoundingBody& body = SoundingBody());
  /// Sets the largest slip speed of the contacts ≥ 0 [m/s]; 0 ends the scraping sound.
  void scrape(double speed);
  /// Returns the next `count` mono samples.
  std::vector<float> render(std::size_t count);

 private:
  /// A decaying oscillation as a rotating phasor.
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
  std::vector<Voice> voices_;               ///< the ringing bodies
  double speed_ = 0.0, heard_speed_ = 0.0;  ///< [m/s]; the second follows the first smoothly, to avoid clicks
  double low_ = 0.0, band_ = 0.0;           ///< state of the noise's band-pass
  std::uint32_t noise_ = 1;
};

}  // namespace spring_workbench::sound
