#pragma once

#include <ros/node_handle.h>

namespace spring_workbench::contact_sound {

/// Runs the node `contact_sound` until shutdown: plays the topic `contacts` as sound on the sound device or into the
/// WAV file `~file`. Reads `~volume` and `~file`. Throws InputError if one is invalid or if there is no sound device.
void run(ros::NodeHandle node, const ros::NodeHandle& private_node);

}  // namespace spring_workbench::contact_sound
