#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::tools {

/// What a tool can hold at its tip; what would take more is let go.
struct LimitSettings {
  double force = std::numeric_limits<double>::infinity();   ///< key `limit.force` [N], > 0
  double moment = std::numeric_limits<double>::infinity();  ///< key `limit.moment` [N·m], > 0
};

/// What size, springs and dampers of a tool are made for at each grasp.
enum class Calibration { none, object };
inline std::vector<std::string> names_of(Calibration) { return {"none", "object"}; }

/// What a released object does: it keeps its twist, or is set to rest.
enum class Release { thrown, dropped };
inline std::vector<std::string> names_of(Release) { return {"thrown", "dropped"}; }

struct GraspSettings {
  Calibration calibrate = Calibration::none;  ///< key `calibrate`: from the object's mass and size
  std::string object = "";             ///< key `grasp.object`: held from the first sample to the last; empty: by button
  std::optional<RigidTransform> X_OE;  ///< key `grasp.tip_in_object` (x y z qx qy qz qw); absent: where the tip is
  bool start_follow = false;           ///< key `start.follow`: move the object so that the grasp fits the first pose
  Release release = Release::thrown;   ///< key `release`
};

}  // namespace spring_workbench::tools
