#pragma once

#include <geometry_msgs/Pose.h>

#include <string>

#include "spring_workbench/SceneDescription.h"

namespace spring_workbench::rviz_plugin {

/// Whether it is finite and its quaternion of length 1, to a tenth.
bool is_pose(const geometry_msgs::Pose& pose);
/// Throws InputError, which names `of`, unless it is a pose.
void check(const geometry_msgs::Pose& pose, const std::string& of);
/// Throws InputError for what cannot be drawn: values that are not finite, indices out of range, a name twice.
void check(const SceneDescription& scene);

}  // namespace spring_workbench::rviz_plugin
