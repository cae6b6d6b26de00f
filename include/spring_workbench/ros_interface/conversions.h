#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <ros/time.h>

#include <string>

#include "spring_workbench/Contacts.h"
#include "spring_workbench/ForkState.h"
#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/StepReport.h"
#include "spring_workbench/TaskState.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/task/task_monitor.h"

namespace spring_workbench {

// The core's values as messages: same frames, same units.
geometry_msgs::Point to_point(const Vector3d& p);
geometry_msgs::Vector3 to_vector(const Vector3d& v);
geometry_msgs::Quaternion to_quaternion(const Matrix3d& R);
geometry_msgs::Pose to_pose(const RigidTransform& X);
geometry_msgs::Wrench to_wrench(const Wrench& wrench);
geometry_msgs::TransformStamped to_transform(const RigidTransform& X, const std::string& parent,
                                             const std::string& child, const ros::Time& stamp);

ObjectStates to_message(const std::vector<BodyState>& objects);
ForkState to_message(const ToolState& tool);
TaskState to_message(const std::vector<Placement>& placements, const TaskScore& score);
Contacts to_message(const std::vector<ContactState>& contacts);
/// Everything but `wall_time`, `integrator` and `deadline_missed`, which the core does not know.
StepReport to_message(const AdvanceReport& report);

}  // namespace spring_workbench
