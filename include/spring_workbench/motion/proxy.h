#pragma once

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// The handle that an object sees while it may be behind the hand: offset · hand, in world (doc/model.md, "When the
/// fork cannot follow").
class Proxy {
 public:
  bool behind() const { return behind_; }
  const RigidTransform& offset() const { return offset_; }

  /// Sets the offset and its rate of change, as the twist of a frame fixed to the handle, at the origin of world.
  void place(const RigidTransform& offset, const Twist& rate);
  /// Stays where it is in world, while the hand moves from `before` to `now`.
  void rest(const RigidTransform& before, const MotionState& now);
  /// An impulse gives it `change`, about the point `p` of world [m].
  void kick(const Twist& change, const Vector3d& p);

  /// The mean rate of an offset that goes from the present one to `offset` in `h` [s], as it moves the handle that is
  /// then seen of a hand at `hand`.
  Twist rate_to(const RigidTransform& offset, const Vector3d& hand, double h) const;
  /// The offset later, if nothing holds it behind and `left` is left of it.
  RigidTransform returned(double left) const;
  /// The handle's motion from `t` [s] on over `h` [s], until it is at `offset`, which changes at this rate from the
  /// start on: a proxy has no mass.
  MotionSegment motion(const MotionSegment& hand, double t, double h, const RigidTransform& offset,
                       const Twist& rate) const;
  /// The handle's motion at present, with its acceleration.
  MotionSegment motion(const MotionSegment& hand, double t) const;
  const Twist& rate() const { return rate_; }

  bool operator==(const Proxy& other) const;
  void exchange(math::StateArchive& state) { state(behind_, offset_, rate_); }

 private:
  bool behind_ = false;
  RigidTransform offset_ = RigidTransform::Identity();
  Twist rate_;  ///< mean over the last step
};

}  // namespace spring_workbench::motion
