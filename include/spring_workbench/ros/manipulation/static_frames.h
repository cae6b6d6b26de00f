#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>

#include "spring_workbench/live/stylus_events.h"
#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::manipulation {

/// A frame's name without the leading slash of old.
std::string frame(const std::string& name);
/// Where a transform stands, for a message about it.
std::string place(const std::string& parent, const std::string& child);
/// A transform as it came, as the gate takes it; `t` [s].
hand_input::RawSample raw_sample(const geometry_msgs::Transform& T, double t);

/// Where the frames of /tf_static are in the world; the workbench is the world until one says otherwise.
class StaticFrames {
 public:
  StaticFrames(const std::string& world, const std::string& workbench);

  /// Takes a transform; what is wrong with one that cannot be used, as reason and line, else nothing.
  std::optional<std::pair<std::string, std::string>> take(const geometry_msgs::TransformStamped& transform,
                                                          const hand_input::InputSettings& rules);
  /// Pose in the world of a frame (world itself: the identity); nothing where no way there is known.
  std::optional<RigidTransform> in_world(const std::string& parent) const;
  /// Whether a message said where the workbench is.
  bool workbench_known() const { return workbench_known_; }

 private:
  std::string world_, workbench_;
  tf2::BufferCore frames_;
  bool workbench_known_ = false;
};

}  // namespace spring_workbench::manipulation
