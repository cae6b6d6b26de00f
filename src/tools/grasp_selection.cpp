#include "spring_workbench/tools/grasp_selection.h"

namespace spring_workbench::tools {

GraspEvent GraspSelection::set_button(bool pressed, bool holding) {
  const bool rising = pressed && !pressed_;
  pressed_ = pressed;
  if (rising && !holding && inserted_) return GraspEvent::grasp;
  if (!pressed && holding) return GraspEvent::release;
  return GraspEvent::none;
}

}  // namespace spring_workbench::tools
