#pragma once

#include <limits>
#include <optional>
#include <string>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::tools {

/// What a tool can hold at its tip; what would take more is let go.
struct LimitSettings {
  double force = std::numeric_limits<double>::infinity();   ///< key `limit.force` [N], > 0
  double moment = std::numeric_limits<double>::infinity();  ///< key `limit.moment` [N·m], > 0
};

struct GraspSettings {
  bool calibrate = false;              ///< key `calibrate`: on every grasp, from the object's mass and size
  std::string object = "";             ///< key `grasp.object`: held from the first sample to the last; empty: by button
  std::optional<RigidTransform> X_OE;  ///< key `grasp.tip_in_object` (x y z qx qy qz qw); absent: where the tip is
  bool start_follow = false;           ///< key `start.follow`: move the object so that the grasp fits the first pose
  std::string release = "thrown";      ///< key `release`: thrown keeps the object's twist, dropped sets it to rest
};

}  // namespace spring_workbench::tools
