#include "spring_workbench/sound/audio_output.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::sound {

std::unique_ptr<AudioOutput> open_audio_device() {
  throw validation::InputError(
      "contact sound: file: missing; this package was built without SDL 2 and can only write sound to a file");
}

}  // namespace spring_workbench::sound
