#pragma once

#include <rviz/display.h>

#include <string>

namespace spring_workbench::rviz_plugin {

/// Places the display's node at the frame of a message, in the fixed frame of rviz. If there is no transform, returns
/// false and sets the display's status.
bool place_node(const std::string& frame, const QString& fixed_frame, rviz::DisplayContext* context,
                rviz::Display& display);

}  // namespace spring_workbench::rviz_plugin
