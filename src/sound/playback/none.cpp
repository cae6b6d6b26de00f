#include "spring_workbench/sound/audio_output.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::sound {

std::unique_ptr<AudioOutput> open_audio_device() {
  validation::refuse_missing("contact sound", "file",
                             "path of a WAV file to write, since this package was built without SDL 2");
}

}  // namespace spring_workbench::sound
