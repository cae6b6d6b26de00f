#pragma once

#include <ros/ros.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <string>

#include "spring_workbench/ProbeReading.h"
#include "spring_workbench/instruments/reading_average.h"
#include "spring_workbench/instruments/vibration.h"
#include "spring_workbench/live/view.h"

namespace spring_workbench::machine_link {

/// What a device or a machine takes of the tool in one hand: `wrench`, which the hand would feel, `tip_twist`, for a
/// servo that follows the tip, and `joy_feedback`, which makes a game pad vibrate; and what the tool measures: `probe`.
/// A message is made only while it has a subscriber.
class ToolOutput {
 public:
  /// `frame_prefix`, `number`: what the frames of this hand begin with, and its topics and frames end in ("", "_2");
  /// `queue`: messages that wait for a slow subscriber.
  ToolOutput(ros::NodeHandle private_node, const std::string& frame_prefix, const std::string& number,
             std::uint32_t queue);

  /// Reads the tool of this hand in the simulation as the instrument that it is, and fills its averages in.
  void read(const live::View& view, tools::ToolState& tool);
  /// Fills in what was read last, for a tool that is shown.
  void show(tools::ToolState& tool) const { average_.fill_in(tool); }
  /// `tool`: that of this hand, as it was read; `header`: the state's stamp, and the world frame.
  void publish(const live::View& view, const tools::ToolState& tool, const std_msgs::Header& header);

 private:
  void vibrate(const live::View& view, const tools::ToolState& tool);

  ProbeReading reading_of(const tools::ToolState& tool) const;

  std::string handle_frame_;
  ros::Publisher wrench_, tip_twist_, joy_feedback_, probe_;
  instruments::ReadingAverage average_;
  instruments::Vibration vibration_;
  double vibrates_ = 0.0;  ///< intensity that was published last
};

}  // namespace spring_workbench::machine_link
