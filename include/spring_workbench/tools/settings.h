#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::tools {

/// Behaviour of a tool at its limit: it releases the object, or it slips in the hand and keeps pulling with the limit
/// force.
enum class LimitAction { let_go, slip };
inline std::vector<std::string> names_of(LimitAction) { return {"let_go", "slip"}; }  ///< their words in settings

/// Largest force and moment of a tool at its tip.
struct LimitSettings {
  double force = std::numeric_limits<double>::infinity();   ///< key `limit.force` [N], > 0
  double moment = std::numeric_limits<double>::infinity();  ///< key `limit.moment` [N·m], > 0
  LimitAction action = LimitAction::let_go;                 ///< key `limit.action`
};

/// What a tool is calibrated for: nothing, each object when it is grasped, or all objects of the scene together.
enum class Calibration { none, object, world };
/// Their words in settings.
inline std::vector<std::string> names_of(Calibration) { return {"none", "object", "world"}; }

/// Deformation of a fork calibrated to an object under the weight of that object (paper, sections 3.1 and 3.2).
struct ObjectGoal {
  double sag = 0.1;     ///< key `calibration.object.sag`: static extension when hanging, and deflection when level, as
                        ///< fractions of L
  double twist = 0.35;  ///< key `calibration.object.twist`: static torsion [rad] of an object as dense as water, held
                        ///< at a lever of its radius of gyration
};

/// Deformation of the one fork for a scene under the weight of the heaviest object (paper, section 4).
struct WorldGoal {
  double stretch = 0.3;  ///< key `calibration.world.stretch`: static extension when hanging, as a fraction of L
  double bend = 0.4;     ///< key `calibration.world.bend`: static deflection of the tip when level, as a fraction of L
  double twist = 0.3;    ///< key `calibration.world.twist`: static torsion at its radius of gyration [rad]
  std::optional<double> heaviest;  ///< key `calibration.world.heaviest` [kg]; absent: that of the scene
};

/// Whether a released object keeps its velocity (thrown) or starts from rest (dropped).
enum class Release { thrown, dropped };
inline std::vector<std::string> names_of(Release) { return {"thrown", "dropped"}; }  ///< their words in settings

/// How tools grasp, calibrate and release.
struct GraspSettings {
  Calibration calibrate = Calibration::none;  ///< key `calibrate`
  ObjectGoal object_goal;                     ///< keys `calibration.object.…`
  WorldGoal world_goal;                       ///< keys `calibration.world.…`
  std::string object =
      "";  ///< key `grasp.object`: object that is held from the first sample on; empty: grasp by button
  std::optional<RigidTransform>
      X_OE;                   ///< key `grasp.tip_in_object` (x y z qx qy qz qw); absent: the tip's pose at the grasp
  std::string object_place;   ///< where `object` was given ("settings.yaml:3"), for messages
  std::string tip_place;      ///< where `X_OE` was given, for messages
  bool start_follow = false;  ///< key `start.follow`: move the object so that the grasp fits the first pose
  Release release = Release::thrown;  ///< key `release`
};

}  // namespace spring_workbench::tools
