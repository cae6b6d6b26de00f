#pragma once

#include <cstddef>
#include <optional>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::tools {

/// What the hand does with the grasp button (paper, section 5): insert the fork, adjust it, press and hold, let go.
enum class GraspEvent { none, grasp, release };

/// Turns the button's level and the object that the tip is inserted in into grasp and release. Pressing in the air
/// grasps nothing, also when the tip enters an object afterwards with the button still down.
class GraspSelection {
 public:
  /// The object whose inside the tip is in at present, if any.
  void set_inserted(std::optional<std::size_t> object) { inserted_ = object; }
  std::optional<std::size_t> inserted() const { return inserted_; }

  /// The button's level; says what follows from it.
  GraspEvent set_button(bool pressed, bool holding);
  bool pressed() const { return pressed_; }

  void exchange(math::StateArchive& state) { state(inserted_, pressed_); }

 private:
  std::optional<std::size_t> inserted_;
  bool pressed_ = false;
};

}  // namespace spring_workbench::tools
