#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <ros/time.h>

#include <cstdint>
#include <string>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::ros_common {

// Conversion of vectors, poses and wrenches to messages, in the same frames and units.
geometry_msgs::Point to_point(const Vector3d& p);
geometry_msgs::Vector3 to_vector(const Vector3d& v);
geometry_msgs::Quaternion to_quaternion(const Matrix3d& R);
geometry_msgs::Pose to_pose(const RigidTransform& X);
geometry_msgs::Wrench to_wrench(const Wrench& wrench);
geometry_msgs::TransformStamped to_transform(const RigidTransform& X, const std::string& parent,
                                             const std::string& child, const ros::Time& stamp);

/// A stamp [ns].
inline std::int64_t nanoseconds_of(const ros::Time& stamp) { return static_cast<std::int64_t>(stamp.toNSec()); }

/// Quaternions are normalised.
RigidTransform from_message(const geometry_msgs::Pose& pose);
RigidTransform from_message(const geometry_msgs::Transform& transform);

}  // namespace spring_workbench::ros_common
