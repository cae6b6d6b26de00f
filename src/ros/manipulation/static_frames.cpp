#include "spring_workbench/ros/manipulation/static_frames.h"

#include <tf2/exceptions.h>

#include "spring_workbench/ros/common/conversions.h"

namespace spring_workbench::manipulation {

std::string frame(const std::string& name) { return !name.empty() && name.front() == '/' ? name.substr(1) : name; }

std::string place(const std::string& parent, const std::string& child) {
  return "tf " + parent + " -> " + child + ": ";
}

hand_input::RawSample raw_sample(const geometry_msgs::Transform& T, double t) {
  return {t, Vector3d(T.translation.x, T.translation.y, T.translation.z),
          Quaterniond(T.rotation.w, T.rotation.x, T.rotation.y, T.rotation.z)};
}

StaticFrames::StaticFrames(const std::string& world, const std::string& workbench)
    : world_(world), workbench_(workbench) {
  if (workbench == world) return;
  frames_.setTransform(ros_common::to_transform(RigidTransform::Identity(), world, workbench, ros::Time()), "default",
                       true);
}

std::optional<std::pair<std::string, std::string>> StaticFrames::take(const geometry_msgs::TransformStamped& transform,
                                                                      const hand_input::InputSettings& rules) {
  const hand_input::RawSample sample = raw_sample(transform.transform, 0.0);
  const hand_input::GateResult result = hand_input::check_pose(sample, rules);
  if (!hand_input::usable(result)) {
    return std::make_pair(hand_input::to_string(result), place(transform.header.frame_id, transform.child_frame_id) +
                                                             hand_input::complaint(result, sample, rules));
  }
  geometry_msgs::TransformStamped normalised = transform;
  Eigen::Map<Eigen::Vector4d> q(&normalised.transform.rotation.x);
  q.normalize();
  frames_.setTransform(normalised, "tf_static", true);
  workbench_known_ |= frame(transform.child_frame_id) == workbench_;
  return std::nullopt;
}

std::optional<RigidTransform> StaticFrames::in_world(const std::string& parent) const {
  if (frame(parent) == world_) return RigidTransform::Identity();
  try {
    return ros_common::from_message(frames_.lookupTransform(world_, frame(parent), ros::Time()).transform);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

}  // namespace spring_workbench::manipulation
