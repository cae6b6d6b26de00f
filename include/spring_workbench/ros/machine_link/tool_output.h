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

/// Topics of the tool in one hand for devices and machines: `wrench`, which the hand would feel; `tip_twist`, for a
/// servo that follows the tip; `joy_feedback`, which makes a game pad vibrate; and `probe`, what the tool measures. A
/// message is built only if it has a subscriber.
class ToolOutput {
 public:
  /// `frame_prefix`: prefix of this hand's frames; `number`: suffix of its topics and frames ("", "_2"); `queue`: queue
  /// size for slow subscribers.
  ToolOutput(ros::NodeHandle private_node, const std::string& frame_prefix, const std::string& number,
             std::uint32_t queue);

  /// Updates this hand's instruments from the state of its tool, and fills in the averages.
  void read(const live::View& view, tools::ToolState& tool);
  /// Fills in the last averages, for a displayed tool.
  void show(tools::ToolState& tool) const { average_.fill_in(tool); }
  /// Publishes the messages. `tool`: state of this hand's tool after read(); `header`: stamp of the state, world frame.
  void publish(const live::View& view, const tools::ToolState& tool, const std_msgs::Header& header);

 private:
  void vibrate(const live::View& view, const tools::ToolState& tool);

  ProbeReading reading_of(const tools::ToolState& tool) const;

  std::string handle_frame_;
  ros::Publisher wrench_, tip_twist_, joy_feedback_, probe_;
  instruments::ReadingAverage average_;
  instruments::Vibration vibration_;
  double vibrates_ = 0.0;  ///< intensity published last
};

}  // namespace spring_workbench::machine_link
