#pragma once

#include "spring_workbench/ros/common/master_watch.h"

namespace spring_workbench::rviz_plugin {

/// The one of this process: it is made at the first call and ends with rviz, not with a display, which would have to
/// wait for a ROS master that hangs. From then on rviz exits without the master if that does not answer.
const ros_common::MasterWatch& shared_master_watch();

}  // namespace spring_workbench::rviz_plugin
