#include "spring_workbench/ros/machine_link/tool_output.h"

#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/JoyFeedbackArray.h>

#include <utility>

#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/ros/common/publishing.h"

namespace spring_workbench::machine_link {

ToolOutput::ToolOutput(ros::NodeHandle private_node, const std::string& frame_prefix, const std::string& number,
                       std::uint32_t queue)
    : handle_frame_(frame_prefix + "fork_handle" + number),
      wrench_(private_node.advertise<geometry_msgs::WrenchStamped>("wrench" + number, queue)),
      tip_twist_(private_node.advertise<geometry_msgs::TwistStamped>("tip_twist" + number, queue)),
      joy_feedback_(private_node.advertise<sensor_msgs::JoyFeedbackArray>("joy_feedback" + number, queue)),
      probe_(private_node.advertise<ProbeReading>("probe" + number, queue)) {}

void ToolOutput::read(const live::View& view, tools::ToolState& tool) {
  RigidTransform X_WT = RigidTransform::Identity();
  if (!tool.touched.empty()) {
    for (const bodies::BodyState& object : view.objects) {
      if (object.name == tool.touched) X_WT = object.X_WO;
    }
  }
  average_.add(view.world_time, tool, X_WT);
}

void ToolOutput::publish(const live::View& view, const tools::ToolState& tool, const std_msgs::Header& header) {
  vibrate(view, tool);
  if (!tool.touched.empty()) ros_common::publish_made(probe_, header, [&] { return reading_of(tool); });
  std_msgs::Header of_handle = header;
  of_handle.frame_id = handle_frame_;
  ros_common::publish_made(wrench_, of_handle, [&] {
    geometry_msgs::WrenchStamped message;
    const Wrench& felt = tool.handle_wrench_H;
    message.wrench = ros_common::to_wrench({felt.force / tool.force_scale, felt.moment / tool.force_scale});
    return message;
  });
  ros_common::publish_made(tip_twist_, header, [&] {
    geometry_msgs::TwistStamped message;
    const Twist V_WE_W = simulation::to_hand_units(tool.V_WE_W, view.settings);
    message.twist.linear = ros_common::to_vector(V_WE_W.linear);
    message.twist.angular = ros_common::to_vector(V_WE_W.angular);
    return message;
  });
}

ProbeReading ToolOutput::reading_of(const tools::ToolState& tool) const {
  ProbeReading message;
  message.touched = tool.touched;
  message.force = tool.handle_wrench_H.force.norm();
  if (const auto& reading = average_.material()) {
    message.identified = 1;
    message.stiffness = reading->material.value;
    message.stiffness_low = reading->material.low;
    message.stiffness_high = reading->material.high;
    message.damping = reading->damping.value;
    message.damping_low = reading->damping.low;
    message.damping_high = reading->damping.high;
    for (const auto& [depth, force] : average_.force_over_depth()) {
      message.depths.push_back(depth);
      message.forces.push_back(force);
    }
  }
  return message;
}

/// Publishes while the tool vibrates, and once more at the end.
void ToolOutput::vibrate(const live::View& view, const tools::ToolState& tool) {
  if (joy_feedback_.getNumSubscribers() == 0) return;
  double impulse = 0.0;
  for (const contact::ContactState& contact : view.contacts) {
    const bool of_held = contact.object == tool.held_object || contact.other == tool.held_object;
    if (of_held && contact.phase == contact::ContactPhase::started) impulse += contact.impulse;
  }
  const double intensity = vibration_.update_intensity(view.time, tool, impulse);
  if (std::exchange(vibrates_, intensity) == 0.0 && intensity == 0.0) return;
  sensor_msgs::JoyFeedbackArray message;
  message.array.resize(1);
  message.array[0].type = sensor_msgs::JoyFeedback::TYPE_RUMBLE;
  message.array[0].intensity = static_cast<float>(intensity);
  joy_feedback_.publish(message);
}

}  // namespace spring_workbench::machine_link
