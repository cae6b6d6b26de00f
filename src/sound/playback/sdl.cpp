#include <SDL.h>

#include "spring_workbench/sound/audio_output.h"
#include "spring_workbench/sound/contact_synthesizer.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::sound {
namespace {

class SdlDevice final : public AudioOutput {
 public:
  SdlDevice() {
    SDL_AudioSpec wanted{};
    wanted.freq = ContactSynthesizer::sample_rate;
    wanted.format = AUDIO_F32SYS;
    wanted.channels = 1;
    wanted.samples = 512;
    if (SDL_InitSubSystem(SDL_INIT_AUDIO) == 0) device_ = SDL_OpenAudioDevice(nullptr, 0, &wanted, nullptr, 0);
    if (device_ == 0)
      throw validation::InputError(std::string("contact sound: sound device: cannot be opened (") + SDL_GetError() +
                                   "); set ~file (sound_file:=PATH) to write a WAV file instead");
    SDL_PauseAudioDevice(device_, 0);
  }
  ~SdlDevice() override {
    SDL_CloseAudioDevice(device_);
    SDL_QuitSubSystem(SDL_INIT_AUDIO);
  }
  SdlDevice(const SdlDevice&) = delete;
  SdlDevice& operator=(const SdlDevice&) = delete;

  void write(const std::vector<float>& samples) override {
    constexpr Uint32 max_waiting = ContactSynthesizer::sample_rate / 5 * sizeof(float);  // a fifth of a second
    if (SDL_GetQueuedAudioSize(device_) > max_waiting) SDL_ClearQueuedAudio(device_);
    SDL_QueueAudio(device_, samples.data(), static_cast<Uint32>(samples.size() * sizeof(float)));
  }

 private:
  SDL_AudioDeviceID device_ = 0;
};

}  // namespace

std::unique_ptr<AudioOutput> open_audio_device() { return std::make_unique<SdlDevice>(); }

}  // namespace spring_workbench::sound
