#include "joy_source.h"

namespace spring_workbench::tracker_driver {

JoySource::JoySource(ros::NodeHandle node, const JoySettings& settings, const RigidTransform& X_WB)
    : motion_(settings, X_WB),
      subscriber_(node.subscribe("joy", 10, &JoySource::on_joy, this, ros::TransportHints().tcpNoDelay())) {}

motion::SourceHealth JoySource::health() const {
  const bool streaming = messages_ > 0;
  return {streaming,
          streaming
              ? "moved by " + subscriber_.getTopic()
              : "nothing on " + subscriber_.getTopic() + ": start the device's node, e.g. joy_node or spacenav_node",
          {{"messages", messages_}}};
}

void JoySource::advance(double dt, motion::StationSample& sample) {
  const RigidTransform& X = motion_.advance(dt);
  sample.p_TS = X.translation();
  sample.q_TS = Quaterniond(X.linear());
  sample.button = motion_.grasp();
  sample.next_tool = motion_.next_tool();
}

void JoySource::on_joy(const sensor_msgs::JoyConstPtr& message) {
  motion_.input(message->axes, message->buttons);
  ++messages_;
}

}  // namespace spring_workbench::tracker_driver
