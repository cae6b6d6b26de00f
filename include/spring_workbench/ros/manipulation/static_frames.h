#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>

#include "spring_workbench/live/stylus_events.h"
#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::manipulation {

/// The name of a frame without the leading slash that older software uses.
std::string frame(const std::string& name);
/// Names a transform by its frames, for messages about it.
std::string place(const std::string& parent, const std::string& child);
/// Converts a transform to a sample for the gate, with the stamp `t` [s].
hand_input::RawSample raw_sample(const geometry_msgs::Transform& T, double t);

/// Poses in the world of the frames on /tf_static. The workbench is the world frame until a message says otherwise.
class StaticFrames {
 public:
  StaticFrames(const std::string& world, const std::string& workbench);

  /// Adds a transform. If it cannot be used, returns a reason and a one-line description; otherwise nothing.
  std::optional<std::pair<std::string, std::string>> take(const geometry_msgs::TransformStamped& transform,
                                                          const hand_input::InputSettings& rules);
  /// Pose of a frame in the world (the identity for the world itself); nothing if no chain of transforms leads there.
  std::optional<RigidTransform> in_world(const std::string& parent) const;
  /// Whether a message has given the pose of the workbench.
  bool workbench_known() const { return workbench_known_; }

 private:
  std::string world_, workbench_;
  tf2::BufferCore frames_;
  bool workbench_known_ = false;
};

}  // namespace spring_workbench::manipulation
