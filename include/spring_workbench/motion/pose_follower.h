#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::motion {

/// A pose that follows a goal that moves in jumps (e.g. a marker dragged at the frame rate of rviz): it approaches the
/// goal with a time constant, and never faster than a hand. It comes to rest at the goal without overshoot.
class PoseFollower {
 public:
  static constexpr double time_constant = 0.03;  ///< [s]
  static constexpr double max_speed = 2.0;       ///< [m/s]
  static constexpr double max_turn_rate = 10.0;  ///< [rad/s]

  explicit PoseFollower(const RigidTransform& start) : X_(start), goal_(start) {}

  void set_goal(const RigidTransform& goal) { goal_ = goal; }
  const RigidTransform& goal() const { return goal_; }
  /// Advances by `dt` [s] ≥ 0 and returns the pose.
  const RigidTransform& advance(double dt);

 private:
  RigidTransform X_, goal_;
};

}  // namespace spring_workbench::motion
