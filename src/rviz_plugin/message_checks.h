#pragma once

#include <geometry_msgs/Pose.h>

#include <string>

#include "spring_workbench/SceneDescription.h"

namespace spring_workbench::rviz_plugin {

/// Whether the pose is finite and its quaternion has length 1 ± 0.1.
bool is_pose(const geometry_msgs::Pose& pose);
/// Throws InputError naming `of` unless the pose is valid.
void check(const geometry_msgs::Pose& pose, const std::string& of);
/// Throws InputError if the scene cannot be drawn: values that are not finite, indices out of range, duplicate names.
void check(const SceneDescription& scene);

}  // namespace spring_workbench::rviz_plugin
