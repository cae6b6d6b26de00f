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

/// What size, springs and dampers of a tool are made for: nothing, each object at its grasp, or once all of the scene.
enum class Calibration { none, object, world };
inline std::vector<std::string> names_of(Calibration) { return {"none", "object", "world"}; }

/// What a fork that is calibrated to an object does under the weight of that object (paper, sections 3.1 and 3.2).
struct ObjectGoal {
  double sag = 0.1;     ///< key `calibration.object.sag`: static extension, hanging, and deflection, level; part of L
  double twist = 0.35;  ///< key `calibration.object.twist`: static twist at the lever of calibrated_length() [rad]
};

/// What the one fork of a world does under the weight of its heaviest object (paper, section 4).
struct WorldGoal {
  double stretch = 0.3;            ///< key `calibration.world.stretch`: static extension, hanging; part of L
  double bend = 0.4;               ///< key `calibration.world.bend`: static deflection of the tip, level; part of L
  double twist = 0.3;              ///< key `calibration.world.twist`: static twist at its radius of gyration [rad]
  std::optional<double> heaviest;  ///< key `calibration.world.heaviest` [kg]; absent: as the scene has it
};

/// What a released object does: it keeps its twist, or is set to rest.
enum class Release { thrown, dropped };
inline std::vector<std::string> names_of(Release) { return {"thrown", "dropped"}; }

struct GraspSettings {
  Calibration calibrate = Calibration::none;  ///< key `calibrate`
  ObjectGoal object_goal;                     ///< keys `calibration.object.*`
  WorldGoal world_goal;                       ///< keys `calibration.world.*`
  std::string object = "";             ///< key `grasp.object`: held from the first sample to the last; empty: by button
  std::optional<RigidTransform> X_OE;  ///< key `grasp.tip_in_object` (x y z qx qy qz qw); absent: where the tip is
  bool start_follow = false;           ///< key `start.follow`: move the object so that the grasp fits the first pose
  Release release = Release::thrown;   ///< key `release`
};

}  // namespace spring_workbench::tools
