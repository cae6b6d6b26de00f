#pragma once

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// The proxy handle, on which the fork acts and which may lag behind the hand. Its pose is offset · hand, in world
/// (doc/model.md, "When the fork cannot follow").
class Proxy {
 public:
  bool behind() const { return behind_; }
  const RigidTransform& offset() const { return offset_; }

  /// Sets the offset and its rate of change, as the twist of a frame fixed to the handle, at the origin of world.
  void place(const RigidTransform& offset, const Twist& rate);
  /// Keeps the proxy at rest in world while the hand moves from `before` to `now`.
  void rest(const RigidTransform& before, const MotionState& now);
  /// Changes the rate by the twist `change` about the point `p` of world [m], as an impulse does.
  void add_rate(const Twist& change, const Vector3d& p);

  /// Returns the mean rate of change from the current offset to `offset` over `h` [s], as seen by the proxy of a hand
  /// that is then at `hand` [m].
  Twist rate_to(const RigidTransform& offset, const Vector3d& hand, double h) const;
  /// Returns the offset reduced to the fraction `left` of the current one.
  RigidTransform reduced_to(double left) const;
  /// Returns the proxy's motion from `t` [s] over `h` [s], at the end of which the offset is `offset`. The offset has
  /// the rate `rate` from the start, because a proxy has no mass.
  MotionSegment motion(const MotionSegment& hand, double t, double h, const RigidTransform& offset,
                       const Twist& rate) const;
  /// Returns the proxy's motion at time `t` [s], with its acceleration.
  MotionSegment motion(const MotionSegment& hand, double t) const;
  const Twist& rate() const { return rate_; }

  bool operator==(const Proxy& other) const;
  void archive(math::StateArchive& state) { state(behind_, offset_, rate_); }

 private:
  bool behind_ = false;
  RigidTransform offset_ = RigidTransform::Identity();
  Twist rate_;  ///< mean over the last step
};

}  // namespace spring_workbench::motion
