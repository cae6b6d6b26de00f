#pragma once

#include <yaml-cpp/yaml.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/fastrak/fastrak_source.h"
#include "spring_workbench/math/rigid_transform.h"
#include "spring_workbench/ros/tracker_driver/joy_motion.h"

namespace spring_workbench::tracker_driver {

/// Default head pose: in front of and above the bench, x axis towards a point 0.1 m above its centre, y to the left.
inline RigidTransform default_head_pose() {
  const Vector3d p(0.0, -0.85, 0.7), x = (Vector3d(0.0, 0.0, 0.1) - p).normalized(), y(-1.0, 0.0, 0.0);
  Matrix3d R;
  R << x, y, x.cross(y);
  return make_transform(p, Quaterniond(R));
}

/// Private parameters of the node `tracker_driver`.
struct TrackerParameters {
  std::string source = "motion_file";  ///< `source`: mouse, joy, fastrak, operator, scripted or motion_file
  std::string file;   ///< `file`, of motion_file and scripted, required: path or package:// URI of the motion or script
  std::string scene;  ///< `scene`, required by operator: URDF of the scene to assemble
  int seed = 1;       ///< `seed` of the operator, 0 … 1e9
  double rate = 0.0;  ///< `rate` [Hz], >= 0: maximum rate of samples sent; 0: every sample
  double speed = 1.0;                         ///< `speed`, 0.01 … 100: 2 plays twice as fast
  bool loop = false;                          ///< `loop`: whether to restart after the last sample
  double pause = 1.0;                         ///< `pause` [s], >= 0: before each pass
  std::string workbench_frame = "workbench";  ///< `workbench_frame`: parent of the frames
  std::string stylus_frame = "stylus";        ///< `stylus_frame`
  std::string head_frame = "head";            ///< `head_frame`; those of further heads end in _2, _3
  RigidTransform X_BT =
      RigidTransform::Identity();  ///< `offset` (x y z qx qy qz qw): the recording's base frame in the workbench
  std::optional<RigidTransform>
      X_BS_first;  ///< `start` (x y z qx qy qz qw): pose of a motion's first sample, instead of `offset`
  std::vector<int> head_stations;  ///< `head_stations`: FASTRAK stations worn on heads, 2 … 4; empty: a fixed head
  RigidTransform X_BHead = default_head_pose();  ///< `head` (pose); with head_stations in the frame of each receiver
  double grasp_from = std::numeric_limits<double>::infinity();  ///< `grasp_from` [s]: the button goes down …
  double grasp_until =
      std::numeric_limits<double>::infinity();  ///< `grasp_until` [s]: … and up; in addition to the file's button
  Vector3d p_ST = Vector3d::Zero();  ///< `tip` (x y z) [m]: the handle's origin in the tracked frame of the stylus
  double interpupillary_distance = 0.063;  ///< `interpupillary_distance` [m], 0 … 0.2: between eye_left and eye_right
  double dropout_after = 0.5;              ///< `dropout_after` [s], > 0: longer gaps do not count in rate and jitter
  bool even_stamps = true;  ///< `even_stamps`: stamp a device's samples by its sample rate, not by receipt
  double latency = 0.0;     ///< `latency` [s], 0 … 1: of a FASTRAK, from the measurement to the first byte received
  fastrak::FastrakSettings fastrak;  ///< read_fastrak_settings; replaces file, speed, loop, pause, start and grasp_*
  JoySettings joy;                   ///< read_joy_settings
};

/// Reads the map of private parameters. Throws InputError with `where`, key, value and rule.
TrackerParameters read_tracker_parameters(const YAML::Node& parameters, const std::string& where);

}  // namespace spring_workbench::tracker_driver
