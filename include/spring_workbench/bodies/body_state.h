#pragma once

#include <string>

#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/scene/scene.h"

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

/// Whether all numbers are the same, bit by bit.
bool same_bits(const BodyState& a, const BodyState& b);
/// The state of a body of a scene to begin with: asleep.
BodyState at_start(const scene::Body& body);

}  // namespace spring_workbench::bodies
