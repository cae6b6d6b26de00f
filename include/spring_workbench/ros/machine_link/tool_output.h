#pragma once

#include <ros/ros.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <string>

#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::machine_link {

/// What a device or a machine takes of the tool in one hand: `wrench`, which the hand would feel, and `tip_twist`, for
/// a servo that follows the tip. A message is made only while it has a subscriber.
class ToolOutput {
 public:
  /// `number`: what the topics and frames of this hand end in ("", "_2"); `queue`: messages that wait for a slow
  /// subscriber.
  ToolOutput(ros::NodeHandle private_node, const std::string& number, std::uint32_t queue);

  /// `header`: the state's stamp, and the world frame.
  void publish(const tools::ToolState& tool, const std_msgs::Header& header) const;

 private:
  std::string handle_frame_;
  ros::Publisher wrench_, tip_twist_;
};

}  // namespace spring_workbench::machine_link
