#include <cmath>
#include <cstdint>
#include <fstream>

#include "spring_workbench/sound/audio_output.h"
#include "spring_workbench/sound/contact_synthesizer.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::sound {
namespace {

/// RIFF WAVE with one channel of 16 bit, little endian.
class WavFile final : public AudioOutput {
 public:
  explicit WavFile(const std::string& path) : file_(path, std::ios::binary) {
    if (!file_) validation::refuse("contact sound", "file", path, "a file that can be written");
    write_header();
  }
  ~WavFile() override {
    file_.seekp(0);
    write_header();
  }

  void write(const std::vector<float>& samples) override {
    for (const float sample : samples) put(static_cast<std::uint32_t>(std::lround(32767.0f * sample)), 2);
    data_bytes_ += static_cast<std::uint32_t>(2 * samples.size());
  }

 private:
  void put(std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) file_.put(static_cast<char>((value >> (8 * i)) & 0xff));
  }
  void write_header() {
    constexpr std::uint32_t rate = ContactSynthesizer::sample_rate;
    file_ << "RIFF";
    put(36 + data_bytes_, 4);
    file_ << "WAVEfmt ";
    put(16, 4);  // bytes that follow
    put(1, 2);   // PCM
    put(1, 2);   // channels
    put(rate, 4);
    put(2 * rate, 4);  // bytes a second
    put(2, 2);         // bytes a frame
    put(16, 2);        // bits a sample
    file_ << "data";
    put(data_bytes_, 4);
  }

  std::ofstream file_;
  std::uint32_t data_bytes_ = 0;
};

}  // namespace

std::unique_ptr<AudioOutput> open_wav_file(const std::string& path) { return std::make_unique<WavFile>(path); }

}  // namespace spring_workbench::sound
