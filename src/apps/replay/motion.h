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

/// A recorded hand. Times are in s from the first sample; stamps are as recorded, including repeated and backward ones.
struct Motion {
  std::vector<motion::StylusSample> samples;  ///< never empty
  std::vector<ButtonEvent> buttons;           ///< changes of the grasp button, which is up at the start
  std::vector<ButtonEvent> next_tool;         ///< the same for the button for the next tool
  std::vector<ButtonEvent> clutch;            ///< the same for the clutch
};

/// Appends the state of a button from time `t` [s] on, if it is a change; the time is at least that of the last change.
void add_button(double t, bool pressed, std::vector<ButtonEvent>& buttons);

/// Reads the source to its end.
Motion read_motion(motion::StylusSource& source);

/// The hands of a bag, by number from 0: the transforms `parent` → `child`, in the world as /tf_static says, with
/// buttons 0, 1 and `clutch_button` of stylus/joy, then `child`_2 with stylus_2/joy, and so on. Times are from the
/// first sample of all hands. Throws InputError.
std::map<std::size_t, Motion> read_bag(const std::string& path, const std::string& parent, const std::string& child,
                                       int clutch_button);

/// The messages of a live run on ~accepted and ~changes, in order and from where both topics were recorded; empty if
/// the bag has none. Throws InputError.
std::vector<live::Entry> read_journal(const std::string& path);

}  // namespace spring_workbench::replay
