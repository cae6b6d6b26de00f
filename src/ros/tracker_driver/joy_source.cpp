#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

#include "message_source.h"
#include "spring_workbench/ros/common/counted_subscriber.h"

namespace spring_workbench::tracker_driver {
namespace {

class JoySource final : public MessageSource {
 public:
  JoySource(const ros::NodeHandle& node, const JoySettings& settings, const RigidTransform& X_WB)
      : motion_(settings, X_WB),
        subscriber_(ros_common::CountedSubscriber::to<const sensor_msgs::JoyConstPtr&>(
            node, "joy", 10, [this](const auto& message) { on_joy(message); })) {}

  motion::SourceHealth health() const override {
    const std::string topic = subscriber_.topic();
    const bool streaming = messages_ > 0;
    return {streaming,
            streaming ? "moved by " + topic
                      : "nothing on " + topic + ": start the device's node, e.g. joy_node or spacenav_node",
            {{"messages", messages_}}};
  }

 private:
  const RigidTransform& advance(double dt, motion::StationSample& sample) override {
    sample.button = motion_.grasp();
    sample.next_tool = motion_.next_tool();
    sample.clutch = motion_.clutch();
    return motion_.advance(dt);
  }

  void on_joy(const sensor_msgs::JoyConstPtr& message) {
    motion_.input(message->axes, message->buttons);
    ++messages_;
  }

  JoyMotion motion_;
  std::size_t messages_ = 0;
  ros_common::CountedSubscriber subscriber_;
};

}  // namespace

std::unique_ptr<motion::LiveSource> make_joy_source(const ros::NodeHandle& node, const JoySettings& settings,
                                                    const RigidTransform& X_WB) {
  return std::make_unique<JoySource>(node, settings, X_WB);
}

}  // namespace spring_workbench::tracker_driver
