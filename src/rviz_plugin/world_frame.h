#pragma once

#include <rviz/display.h>

#include <string>

namespace spring_workbench::rviz_plugin {

/// Puts the display's node where the frame of a message is in the fixed frame of rviz. Returns false, and says so in
/// the display's status, if there is no transform.
bool place_node(const std::string& frame, const QString& fixed_frame, rviz::DisplayContext* context,
                rviz::Display& display);

}  // namespace spring_workbench::rviz_plugin
