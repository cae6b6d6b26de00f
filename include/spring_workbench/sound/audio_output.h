#pragma once

#include <memory>
#include <string>
#include <vector>

namespace spring_workbench::sound {

/// Sink for sound: mono samples in −1 … 1 at ContactSynthesizer::sample_rate.
class AudioOutput {
 public:
  virtual ~AudioOutput() = default;
  virtual void write(const std::vector<float>& samples) = 0;
};

/// A WAV file (16 bit), which is written atomically when the output is destroyed. Throws InputError if it cannot be
/// written.
std::unique_ptr<AudioOutput> open_wav_file(const std::string& path);

/// The default sound device, through SDL 2. Throws InputError if there is none, or if the package was built without
/// SDL.
std::unique_ptr<AudioOutput> open_audio_device();

}  // namespace spring_workbench::sound
