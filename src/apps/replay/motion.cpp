#include "motion.h"

#include <algorithm>

namespace spring_workbench::replay {

void add_button(double t, bool pressed, std::vector<ButtonEvent>& buttons) {
  const bool before = !buttons.empty() && buttons.back().pressed;
  if (pressed == before) return;
  buttons.push_back({buttons.empty() ? t : std::max(t, buttons.back().t), pressed});
}

Motion read_motion(motion::StylusSource& source) {
  Motion motion;
  while (const auto sample = source.next()) {
    motion.samples.push_back(*sample);
    add_button(sample->t, sample->button, motion.buttons);
  }
  return motion;
}

}  // namespace spring_workbench::replay
