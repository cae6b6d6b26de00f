#pragma once

#include <ros/node_handle.h>

namespace spring_workbench::contact_sound {

/// The node `contact_sound`: `contacts` in, sound out, to the sound device or to the WAV file `~file`; until shutdown.
/// Reads `~volume` and `~file`. Throws InputError when one cannot be used or there is no sound device.
void run(ros::NodeHandle node, const ros::NodeHandle& private_node);

}  // namespace spring_workbench::contact_sound
