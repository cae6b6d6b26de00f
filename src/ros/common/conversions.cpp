#include "spring_workbench/ros/common/conversions.h"

namespace spring_workbench::ros_common {
namespace {

template <typename Message>
Message with_xyz(const Vector3d& v) {
  Message message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

template <typename Vector>
RigidTransform transform_from(const Vector& p, const geometry_msgs::Quaternion& q) {
  return make_transform(Vector3d(p.x, p.y, p.z), Quaterniond(q.w, q.x, q.y, q.z));
}

}  // namespace

geometry_msgs::Point to_point(const Vector3d& p) { return with_xyz<geometry_msgs::Point>(p); }
geometry_msgs::Vector3 to_vector(const Vector3d& v) { return with_xyz<geometry_msgs::Vector3>(v); }

geometry_msgs::Quaternion to_quaternion(const Matrix3d& R) {
  const Quaterniond q(R);
  geometry_msgs::Quaternion message;
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  message.w = q.w();
  return message;
}

geometry_msgs::Pose to_pose(const RigidTransform& X) {
  geometry_msgs::Pose message;
  message.position = to_point(X.translation());
  message.orientation = to_quaternion(X.linear());
  return message;
}

geometry_msgs::Wrench to_wrench(const Wrench& wrench) {
  geometry_msgs::Wrench message;
  message.force = to_vector(wrench.force);
  message.torque = to_vector(wrench.moment);
  return message;
}

geometry_msgs::TransformStamped to_transform(const RigidTransform& X, const std::string& parent,
                                             const std::string& child, const ros::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = stamp;
  message.child_frame_id = child;
  message.transform.translation = to_vector(X.translation());
  message.transform.rotation = to_quaternion(X.linear());
  return message;
}

RigidTransform from_message(const geometry_msgs::Pose& pose) { return transform_from(pose.position, pose.orientation); }
RigidTransform from_message(const geometry_msgs::Transform& transform) {
  return transform_from(transform.translation, transform.rotation);
}

}  // namespace spring_workbench::ros_common
