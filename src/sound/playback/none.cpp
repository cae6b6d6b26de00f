#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/sound/audio_output.h"

namespace spring_workbench {

std::unique_ptr<AudioOutput> open_audio_device() {
  refuse("contact sound", "file", "(nothing)", "given: this package was built without SDL 2, which plays sound");
}

}  // namespace spring_workbench
