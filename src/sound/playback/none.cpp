#include "spring_workbench/sound/audio_output.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::sound {

std::unique_ptr<AudioOutput> open_audio_device() {
  validation::refuse("contact sound", "file", "",
                     "a file to write: this package was built without SDL 2, which plays sound");
}

}  // namespace spring_workbench::sound
