#pragma once

#include <string>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::bodies {

/// State of one movable object, at its object frame O (centre of mass), in world axes.
struct BodyState {
  std::string name;
  RigidTransform X_WO = RigidTransform::Identity();
  Twist V_WO_W;  ///< [m/s, rad/s]
  bool held = false;
  bool highlighted = false;  ///< whether the tip or ray of an empty hand touches it: it can be grasped
  bool in_contact = false;
  bool asleep = true;

  void exchange(math::StateArchive& state) { state(X_WO, V_WO_W, held, highlighted, in_contact, asleep); }
};

}  // namespace spring_workbench::bodies
