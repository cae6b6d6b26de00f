#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>

#include "spring_workbench/config/output_file.h"
#include "spring_workbench/sound/audio_output.h"
#include "spring_workbench/sound/contact_synthesizer.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::sound {
namespace {

std::string bytes_of(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>((value >> (8 * i)) & 0xff);
  return text;
}

/// RIFF WAVE file with one channel of 16 bits, little endian, which gets its final name once it is complete.
class WavFile final : public AudioOutput {
 public:
  explicit WavFile(const std::string& path) : file_(path) { file_.write(header()); }
  ~WavFile() override {
    try {
      file_.write_begin(header());
      file_.commit();
    } catch (const validation::InputError& error) {
      std::cerr << error.what() << std::endl;
    }
  }

  void write(const std::vector<float>& samples) override {
    std::string data;
    for (const float sample : samples) data += bytes_of(static_cast<std::uint32_t>(std::lround(32767.0f * sample)), 2);
    file_.write(data);
    data_bytes_ += static_cast<std::uint32_t>(data.size());
  }

 private:
  std::string header() const {
    constexpr std::uint32_t rate = ContactSynthesizer::sample_rate, pcm = 1, channels = 1, frame_bytes = 2, bits = 16;
    return "RIFF" + bytes_of(36 + data_bytes_, 4) + "WAVEfmt " + bytes_of(16, 4) + bytes_of(pcm, 2) +
           bytes_of(channels, 2) + bytes_of(rate, 4) + bytes_of(frame_bytes * rate, 4) + bytes_of(frame_bytes, 2) +
           bytes_of(bits, 2) + "data" + bytes_of(data_bytes_, 4);
  }

  config::OutputFile file_;
  std::uint32_t data_bytes_ = 0;
};

}  // namespace

std::unique_ptr<AudioOutput> open_wav_file(const std::string& path) { return std::make_unique<WavFile>(path); }

}  // namespace spring_workbench::sound
