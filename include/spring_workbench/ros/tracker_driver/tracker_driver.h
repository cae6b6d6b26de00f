#pragma once

#include <ros/node_handle.h>

#include <string>

#include "spring_workbench/motion/live_source.h"

namespace spring_workbench::tracker_driver {

/// What keeps a sample of this `source` (see TrackerParameters) from being a transform; empty where nothing does. A
/// FASTRAK's receiver is never in its transmitter: a pose that is the identity to the bit says that it is not seen.
std::string why_not_sent(const motion::StationSample& sample, const std::string& source);

/// The node `tracker_driver`: plays a motion in its own time, once or for ever with `loop`, or passes a device's
/// samples on, or those of a stylus that is moved by messages (a marker in rviz, a game pad), as tf frames (stylus,
/// head) and buttons (`stylus/joy`, of station k `stylus_k/joy`; 0: grasp, 1: next tool), stamped with the moment at
/// which each sample is due (a device's: at which it came); until shutdown. A device's station 1 is the stylus,
/// head_station the head, station k else the frame stylus_k. Poses are passed on raw: who follows them gates and
/// smooths. Throws InputError when a parameter or the file cannot be used.
void run(ros::NodeHandle node, ros::NodeHandle private_node);

}  // namespace spring_workbench::tracker_driver
