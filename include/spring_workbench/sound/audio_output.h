#pragma once

#include <memory>
#include <string>
#include <vector>

namespace spring_workbench::sound {

/// Where sound goes: mono samples in −1 … 1 at ContactSynthesizer::sample_rate.
class AudioOutput {
 public:
  virtual ~AudioOutput() = default;
  virtual void write(const std::vector<float>& samples) = 0;
};

/// A WAV file (16 bit), which appears whole when the output is destroyed. Throws InputError when it cannot be written.
std::unique_ptr<AudioOutput> open_wav_file(const std::string& path);

/// The default sound device, through SDL 2. Throws InputError when there is none, or where the package was built
/// without.
std::unique_ptr<AudioOutput> open_audio_device();

}  // namespace spring_workbench::sound
