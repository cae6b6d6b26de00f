#pragma once

#include <string>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::assembly {

/// An object that the simulated operator brings to its target. `turns`: the tools turn what they hold.
class OperatorJob {
 public:
  OperatorJob(scene::Body body, scene::Target target);

  const std::string& object() const { return body_.name; }
  Vector3d p_WT() const { return target_.X_WL.translation(); }  ///< the target
  /// Where the object is to be held, in its frame O, one point per hand that carries it.
  std::vector<Vector3d> grips() const;
  /// Whether the object is where it belongs or, if it cannot be turned, as near as can be.
  bool done(const bodies::BodyState& object, bool turns) const;
  /// The pose of its frame O at its target, `lift` [m] above; in the attitude that it has if it cannot be turned.
  RigidTransform goal(const bodies::BodyState& object, bool turns, double lift) const;
  /// Whether it is too far from `X_WO_goal` to be set down: across, in its angle or, with `height_too`, above.
  bool off(const bodies::BodyState& object, const RigidTransform& X_WO_goal, bool height_too) const;

  int attempts = 0;

 private:
  bool can_be_turned(bool turns) const;

  scene::Body body_;
  scene::Target target_;
};

}  // namespace spring_workbench::assembly
