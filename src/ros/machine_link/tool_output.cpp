#include "spring_workbench/ros/machine_link/tool_output.h"

#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>

#include "spring_workbench/ros/common/conversions.h"

namespace spring_workbench::machine_link {

ToolOutput::ToolOutput(ros::NodeHandle private_node, const std::string& number, std::uint32_t queue)
    : handle_frame_("fork_handle" + number),
      wrench_(private_node.advertise<geometry_msgs::WrenchStamped>("wrench" + number, queue)),
      tip_twist_(private_node.advertise<geometry_msgs::TwistStamped>("tip_twist" + number, queue)) {}

void ToolOutput::publish(const tools::ToolState& tool, const std_msgs::Header& header) const {
  if (wrench_.getNumSubscribers() > 0) {
    geometry_msgs::WrenchStamped message;
    message.header = header;
    message.header.frame_id = handle_frame_;
    const Wrench& felt = tool.handle_wrench_H;
    message.wrench = ros_common::to_wrench({felt.force / tool.force_scale, felt.moment / tool.force_scale});
    wrench_.publish(message);
  }
  if (tip_twist_.getNumSubscribers() > 0) {
    geometry_msgs::TwistStamped message;
    message.header = header;
    message.twist.linear = ros_common::to_vector(tool.V_WE_W.linear);
    message.twist.angular = ros_common::to_vector(tool.V_WE_W.angular);
    tip_twist_.publish(message);
  }
}

}  // namespace spring_workbench::machine_link
