#pragma once

namespace spring_workbench::rviz_plugin {

/// From now on this program ends within a few seconds of its windows, or of SIGINT: roscpp takes leave of the ROS
/// master without a time limit, so a master that hangs would keep it for ever. All that rviz saves is saved by then. Of
/// the GUI's thread; a second call does nothing.
void guard_exit();

}  // namespace spring_workbench::rviz_plugin
