#pragma once

namespace spring_workbench::rviz_plugin {

/// From now on this program exits within a few seconds after its windows are closed, or after SIGINT. Without this, a
/// hanging ROS master would block the exit forever, because roscpp unregisters without a timeout. rviz has saved
/// everything by then. Call from the GUI thread; a second call does nothing.
void guard_exit();

}  // namespace spring_workbench::rviz_plugin
