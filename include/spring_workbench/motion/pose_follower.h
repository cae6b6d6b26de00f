#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::motion {

/// A pose that follows a goal which jumps (a dragged marker's, at the rate of its picture): towards it with
/// a time constant, and never faster than a hand. It reaches a goal at rest and does not go beyond it.
class PoseFollower {
 public:
  static constexpr double time_constant = 0.03;  ///< [s]
  static constexpr double max_speed = 2.0;       ///< [m/s]
  static constexpr double max_turn_rate = 10.0;  ///< [rad/s]

  explicit PoseFollower(const RigidTransform& start) : X_(start), goal_(start) {}

  void set_goal(const RigidTransform& goal) { goal_ = goal; }
  const RigidTransform& goal() const { return goal_; }
  /// The pose `dt` [s] ≥ 0 later.
  const RigidTransform& advance(double dt);

 private:
  RigidTransform X_, goal_;
};

}  // namespace spring_workbench::motion
