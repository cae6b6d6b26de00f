#pragma once

#include <ros/node_handle.h>

#include <string>

#include "spring_workbench/motion/live_source.h"

namespace spring_workbench::tracker_driver {

/// Returns why a sample from this `source` (see TrackerParameters) cannot be sent as a transform; empty if it can. The
/// receiver of a FASTRAK is never inside its transmitter, so a pose that is exactly the identity means that the
/// receiver is out of view.
std::string why_not_sent(const motion::StationSample& sample, const std::string& source);

/// Returns the name of an eye's frame (`eye`: eye_left or eye_right): that of the head's frame, with the eye in place
/// of "head" (left_head_2: left_eye_left_2), or behind it if it does not contain "head" (visitor: visitor_eye_left).
std::string eye_frame(const std::string& head_frame, const std::string& eye);

/// Runs the node `tracker_driver` until shutdown. It plays a motion once (repeatedly with `loop`), or passes on the
/// samples of a device or of a stylus moved by messages (a marker in rviz, a game pad). It sends tf frames (stylus,
/// head) and buttons (`stylus/joy`, of station k `stylus_k/joy`; 0: grasp, 1: next tool), stamped with the time at
/// which each sample is due or, from a device, was measured: `latency` before it arrived. Station 1 of a device is the
/// stylus, head_stations are the heads (frames head, head_2, …), and any other station k is the frame stylus_k. Poses
/// are passed on raw; the receiver gates and smooths them. Throws InputError if a parameter or the file cannot be used.
void run(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

}  // namespace spring_workbench::tracker_driver
