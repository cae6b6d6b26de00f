#pragma once

#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <map>
#include <memory>
#include <string>

#include "spring_workbench/fastrak/station_stream.h"
#include "spring_workbench/motion/live_source.h"
#include "spring_workbench/motion/stylus_source.h"
#include "spring_workbench/ros/common/diagnostic_status.h"
#include "spring_workbench/ros/tracker_driver/operator_eyes.h"
#include "spring_workbench/ros/tracker_driver/tracker_parameters.h"

namespace spring_workbench::tracker_driver {

/// What keeps a sample of this `source` (see TrackerParameters) from being a transform; empty where nothing does. A
/// FASTRAK's receiver is never in its transmitter: a pose that is the identity to the bit says that it is not seen.
std::string why_not_sent(const motion::StationSample& sample, const std::string& source);

/// The node `tracker_driver`: plays a motion in its own time, or passes a device's samples on, or those of
/// a stylus that is moved by messages (a marker in rviz, a game pad), as tf frames (stylus,
/// head) and buttons (`stylus/joy`, of station k `stylus_k/joy`; 0: grasp, 1: next tool), stamped with the moment at
/// which each sample is due (a device's: at which it came). A device's station 1 is the stylus, head_station the head,
/// station k else the frame stylus_k. Poses are passed on raw: who follows them gates and smooths.
class TrackerDriver {
 public:
  /// Throws InputError when a parameter or the file cannot be used.
  TrackerDriver(ros::NodeHandle node, ros::NodeHandle private_node);

  /// Plays until the motion is over (once, or for ever with `loop`), or passes on what the device says; until shutdown.
  void run();

 private:
  void play();
  void stream();
  void send(const motion::StationSample& sample);
  /// Of the stylus that is this station.
  void send_buttons(int station, bool grasp, bool next_tool, const ros::Time& stamp);
  std::string frame_of(int station) const;
  geometry_msgs::TransformStamped transform_of(int station, const RigidTransform& X_TS, const ros::Time& stamp) const;
  void add_health(ros_common::DiagnosticStatusBuilder& status) const;
  void send(const motion::StylusSample& sample, const ros::Time& stamp);
  void send_eyes();
  void wait_until(double t);
  void publish_diagnostics();
  std::unique_ptr<motion::StylusSource> open();
  std::unique_ptr<motion::LiveSource> open_device(ros::NodeHandle node, ros::NodeHandle private_node) const;

  const TrackerParameters parameters_;
  const std::string name_;
  std::unique_ptr<motion::LiveSource> device_;
  struct Station {
    explicit Station(const TrackerParameters& p) : stream(p.dropout_after, p.even_stamps) {}
    fastrak::StationStream stream;
    ros::Time newest;                             ///< stamp of the last sample sent
    std::map<std::string, std::size_t> not_sent;  ///< by reason
  };
  std::map<int, Station> stations_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  RigidTransform X_BT_;
  std::unique_ptr<OperatorEyes> eyes_;  ///< for the operator
  std::size_t sent_ = 0, not_sent_ = 0, passes_ = 0;
  double interval_ = 0.0;  ///< between the last two samples sent [s]
  bool over_ = false;
  double next_diagnostics_ = 0.0;
  tf2_ros::TransformBroadcaster transforms_;
  std::map<int, ros::Publisher> joy_publishers_;  ///< by station
  ros::Publisher diagnostics_publisher_;
};

}  // namespace spring_workbench::tracker_driver
