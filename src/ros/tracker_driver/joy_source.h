#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

#include "message_source.h"
#include "spring_workbench/ros/tracker_driver/joy_motion.h"

namespace spring_workbench::tracker_driver {

/// A stylus moved by the messages of a game pad or a 3D mouse on the topic `joy`.
class JoySource : public MessageSource {
 public:
  /// `X_WB`: the stylus at the start, in the workbench.
  JoySource(ros::NodeHandle node, const JoySettings& settings, const RigidTransform& X_WB);
  motion::SourceHealth health() const override;

 private:
  void advance(double dt, motion::StationSample& sample) override;
  void on_joy(const sensor_msgs::JoyConstPtr& message);

  JoyMotion motion_;
  std::size_t messages_ = 0;
  ros::Subscriber subscriber_;
};

}  // namespace spring_workbench::tracker_driver
