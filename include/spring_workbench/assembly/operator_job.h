#pragma once

#include <string>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::assembly {

/// An object that the simulated operator brings to its target. `turns`: whether the tools turn the object that they
/// hold.
class OperatorJob {
 public:
  OperatorJob(scene::Body body, scene::Target target);

  const std::string& object() const { return body_.name; }
  Vector3d p_WT() const { return target_.X_WL.translation(); }  ///< the target
  /// Points at which the object is grasped, in its frame O [m], one for each hand that carries it.
  std::vector<Vector3d> grips() const;
  /// Whether the object is at its target or, if it cannot be turned, at the target's position.
  bool done(const bodies::BodyState& object, bool turns) const;
  /// The pose of its frame O `lift` [m] above its target; if it cannot be turned, with its current orientation.
  RigidTransform goal(const bodies::BodyState& object, bool turns, double lift) const;
  /// Whether it is too far from `X_WO_goal` to be set down: horizontally, in angle or, with `height_too`, in height.
  bool off(const bodies::BodyState& object, const RigidTransform& X_WO_goal, bool height_too) const;

  int attempts = 0;

 private:
  bool can_be_turned(bool turns) const;

  scene::Body body_;
  scene::Target target_;
};

}  // namespace spring_workbench::assembly
