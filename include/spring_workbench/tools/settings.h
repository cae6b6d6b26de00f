#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::tools {

/// Behaviour of a tool at its limit: it lets the object go, or it slips in the hand and keeps pulling with the limit.
enum class LimitAction { let_go, slip };
inline std::vector<std::string> names_of(LimitAction) { return {"let_go", "slip"}; }  ///< words in settings

/// Largest force and moment of a tool at its tip, and the behaviour beyond them.
struct LimitSettings {
  double force = std::numeric_limits<double>::infinity();   ///< key `limit.force` [N], > 0
  double moment = std::numeric_limits<double>::infinity();  ///< key `limit.moment` [N·m], > 0
  LimitAction action = LimitAction::let_go;                 ///< what happens beyond the limit (key `limit.action`)
};

/// Objects for which a tool's stiffness is chosen: none, each one when it is grasped, or all of the scene together.
enum class Calibration { none, object, world };
/// Words for the calibrations in settings.
inline std::vector<std::string> names_of(Calibration) { return {"none", "object", "world"}; }

/// Deformation, under the weight of an object, of a fork that is calibrated to it (paper, sections 3.1 and 3.2).
struct ObjectGoal {
  /// Key `calibration.object.sag`, 1e-3 … 0.6: extension of the hanging and deflection of the level fork / its length.
  double sag = 0.1;
  /// Key `calibration.object.twist` [rad], 1e-3 … 1.5: torsion by an object as dense as water at a lever of its radius
  /// of gyration.
  double twist = 0.35;
};

/// Deformation, under the weight of the heaviest object, of the fork that serves a whole scene (paper, section 4).
struct WorldGoal {
  double stretch = 0.3;  ///< key `calibration.world.stretch`, 1e-3 … 3: extension of the hanging fork / its length
  double bend = 0.4;     ///< key `calibration.world.bend`, 1e-3 … 0.6: deflection of the level fork / its length
  double twist = 0.3;  ///< key `calibration.world.twist` [rad], 1e-3 … 1: torsion at the object's radius of gyration
  std::optional<double> heaviest;  ///< key `calibration.world.heaviest` [kg], 1e-6 … 1e6; absent: that of the scene
};

/// Motion of an object after its release: it keeps its velocity (thrown) or starts from rest (dropped).
enum class Release { thrown, dropped };
inline std::vector<std::string> names_of(Release) { return {"thrown", "dropped"}; }  ///< words in settings

/// How tools grasp, calibrate and release.
struct GraspSettings {
  Calibration calibrate = Calibration::none;  ///< objects that the stiffness is chosen for (key `calibrate`)
  ObjectGoal object_goal;                     ///< keys `calibration.object.…`
  WorldGoal world_goal;                       ///< keys `calibration.world.…`
  /// Key `grasp.object`: name of the object that is held from the first sample on; empty: grasp by button.
  std::string object = "";
  /// Key `grasp.tip_in_object` (x y z qx qy qz qw): pose of the tip in the object; absent: its pose at the grasp.
  std::optional<RigidTransform> X_OE;
  std::string object_location;        ///< internal: the place in a file of `object`, for messages
  std::string tip_location;           ///< internal: the place in a file of `X_OE`, for messages
  bool start_follow = false;          ///< key `start.follow`: whether to move the object so that the first pose fits
  Release release = Release::thrown;  ///< motion after a release (key `release`)
};

}  // namespace spring_workbench::tools
