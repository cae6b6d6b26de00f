#pragma once

#include <ros/node_handle.h>

#include <string>

#include "spring_workbench/ros/markers/markers.h"

namespace spring_workbench::markers {

/// Publishes `~markers` (everything) and `~display/markers` (what the rviz displays leave to markers), each while it
/// has a subscriber.
class MarkerPublisher {
 public:
  /// `fork_curve`, `fork_diameter`: see MarkerBuilder. `rate`: maximum rate of each topic [Hz].
  MarkerPublisher(ros::NodeHandle private_node, const std::string& fork_curve, double fork_diameter, double rate);

  /// Returns whether markers were due at the local time `now` [s] and were built.
  bool publish(const live::View& view, const std_msgs::Header& header, double now);

 private:
  double period_;  ///< [s]
  double next_ = 0.0;
  MarkerBuilder all_, display_markers_;
  ros::Publisher all_publisher_, display_publisher_;
};

}  // namespace spring_workbench::markers
