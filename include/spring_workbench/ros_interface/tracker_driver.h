#pragma once

#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <yaml-cpp/yaml.h>

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "spring_workbench/ros_interface/diagnostics.h"
#include "spring_workbench/ros_interface/operator_eyes.h"
#include "spring_workbench/tracker/fastrak_source.h"
#include "spring_workbench/tracker/joy_motion.h"
#include "spring_workbench/tracker/station_stream.h"
#include "spring_workbench/tracker/stylus_source.h"

namespace spring_workbench {

/// Private parameters of the node `tracker_driver`.
struct TrackerParameters {
  std::string source = "motion_file";  ///< `source`: motion_file, scripted, fastrak, operator, interactive_marker or joy
  std::string file;    ///< `file`, of motion_file and scripted, required: path or package:// URI of the motion or script
  std::string scene;   ///< `scene`, required by operator: URDF of the scene to assemble
  int seed = 1;        ///< `seed` of the operator, 0 … 1e9
  double rate = 0.0;   ///< `rate` [Hz], >= 0: the most that is sent; 0: every sample
  double speed = 1.0;  ///< `speed`, 0.01 … 100: 2 plays twice as fast
  bool loop = false;   ///< `loop`: from the start again after the last sample
  double pause = 1.0;  ///< `pause` [s], >= 0: before each pass
  std::string workbench_frame = "workbench";  ///< `workbench_frame`: parent of the frames
  std::string stylus_frame = "stylus";        ///< `stylus_frame`
  std::string head_frame = "head";            ///< `head_frame`
  RigidTransform X_BT =
      RigidTransform::Identity();  ///< `offset` (x y z qx qy qz qw): the recording's base frame in the workbench
  std::optional<RigidTransform>
      X_BS_first;  ///< `start` (x y z qx qy qz qw): where the first sample lies; of a motion, instead of `offset`
  RigidTransform X_BHead = make_transform(Quaterniond::Identity(), Vector3d(0.0, -0.7, 0.6));  ///< `head` (pose)
  double grasp_from = std::numeric_limits<double>::infinity();  ///< `grasp_from` [s]: the button goes down …
  double grasp_until = std::numeric_limits<double>::infinity();  ///< `grasp_until` [s]: … and up, beside the file's own
  Vector3d p_ST = Vector3d::Zero();      ///< `tip` (x y z) [m]: the handle's origin in the tracked frame of the stylus
  double interpupillary_distance = 0.063;  ///< `interpupillary_distance` [m], 0 … 0.2: between eye_left and eye_right
  double dropout_after = 0.5;              ///< `dropout_after` [s], > 0: a longer gap is a dropout
  bool even_stamps = true;                 ///< `even_stamps`: stamp a device's samples by its cadence, not by receipt
  TruthSettings truth;                     ///< `truth`: which samples are let through, and how they are filtered
  FastrakSettings fastrak;  ///< read_fastrak_settings; in place of file, speed, loop, pause, start and grasp_*
  JoySettings joy;          ///< read_joy_settings
};

/// Reads the map of private parameters. Throws InputError with `where`, key, value and rule.
TrackerParameters read_tracker_parameters(const YAML::Node& parameters, const std::string& where);

/// The node `tracker_driver`: plays a motion in its own time, or passes a device's samples on, or those of
/// a stylus that is moved by messages (a marker in rviz, a game pad), as tf frames (stylus,
/// head) and buttons (`stylus/joy`, 0: grasp, 1: next tool), stamped with the moment at which each sample is due (a
/// device's: at which it came). A device's station 1 is the stylus; station k is the frame stylus_k.
class TrackerDriver {
 public:
  /// Throws InputError when a parameter or the file cannot be used.
  TrackerDriver(ros::NodeHandle node, ros::NodeHandle private_node);

  /// Plays until the motion is over (once, or for ever with `loop`), or passes on what the device says; until shutdown.
  void run();

 private:
  void play();
  void stream();
  void send(const StationSample& sample);
  void send_buttons(bool grasp, bool next_tool, const ros::Time& stamp);
  void add_health(DiagnosticStatusBuilder& status) const;
  void send(const StylusSample& sample, const ros::Time& stamp);
  void send_eyes();
  StationStream& stream_of(int station);
  void wait_until(double t);
  void publish_diagnostics();
  std::unique_ptr<StylusSource> open();
  std::unique_ptr<LiveSource> open_device(ros::NodeHandle node, ros::NodeHandle private_node) const;

  const TrackerParameters parameters_;
  const std::string name_;
  std::unique_ptr<LiveSource> device_;
  std::map<int, ros::Time> newest_;  ///< stamp of each station's last sample sent
  std::map<int, StationStream> streams_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  RigidTransform X_BT_;
  std::unique_ptr<OperatorEyes> eyes_;  ///< for the operator
  TruthLayer played_;  ///< the motion that is played
  std::size_t sent_ = 0, left_out_ = 0, passes_ = 0;
  double interval_ = 0.0;  ///< between the last two samples sent [s]
  bool over_ = false;
  double next_diagnostics_ = 0.0;
  tf2_ros::TransformBroadcaster transforms_;
  ros::Publisher joy_publisher_, diagnostics_publisher_;
};

}  // namespace spring_workbench
