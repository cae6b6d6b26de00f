#pragma once

#include <map>
#include <string>
#include <vector>

#include "spring_workbench/live/journal.h"
#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::replay {

struct ButtonEvent {
  double t = 0.0;  ///< [s]
  bool pressed = false;
};

/// A recorded hand. Times in s from the first sample; stamps as recorded, also repeated and backward ones.
struct Motion {
  std::vector<motion::PoseSample> samples;  ///< never empty
  std::vector<ButtonEvent> buttons;         ///< changes of the grasp button, which starts up
  std::vector<ButtonEvent> next_tool;       ///< the same of the button for the next tool
  std::vector<ButtonEvent> clutch;          ///< and of the clutch
};

/// Appends that the button is down or up from `t` on, but no earlier than the last change, if that is a change.
void add_button(double t, bool pressed, std::vector<ButtonEvent>& buttons);

/// Everything that the source has.
Motion read_motion(motion::StylusSource& source);

/// The hands of a bag, by number from 0: the transforms `parent` → `child` with buttons 0, 1 and `clutch_button` of
/// stylus/joy, then `child`_2 with stylus_2/joy, and so on. Times from the first sample of all. Throws InputError.
std::map<std::size_t, Motion> read_bag(const std::string& path, const std::string& parent, const std::string& child,
                                       int clutch_button);

/// What a live run published on ~accepted and ~changes, in order; empty where the bag has none of it. Throws
/// InputError.
std::vector<live::Entry> read_journal(const std::string& path);

}  // namespace spring_workbench::replay
