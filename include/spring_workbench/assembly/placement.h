#pragma once

#include <string>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::assembly {

/// Pose error of an object from its target.
struct Placement {
  std::string object;
  double position_error = 0.0;  ///< distance of the link frame's origin from the target's [m]
  double angle_error = 0.0;     ///< angle of the rotation between them, 0 … π [rad]
  bool in_place = false;        ///< both are within the target's tolerances, and the object is neither held nor broken
  bool broken = false;          ///< a contact force on it has exceeded the target's `max_force`
};

/// Returns the placement of a body whose object frame is at `X_WO`; `broken` is left false.
Placement judge_placement(const scene::Body& body, const scene::Target& target, const RigidTransform& X_WO, bool held);

/// Whether the target constrains the angle: a tolerance of half a turn or more allows any angle.
bool angle_matters(const scene::Target& target);

}  // namespace spring_workbench::assembly
