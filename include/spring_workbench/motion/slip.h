#pragma once

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// Displacement of a tool's stylus from the hand's after the tool has slipped, and its return (doc/model.md, "At the
/// limit").
class Slip {
 public:
  bool open() const { return open_; }
  void close() { open_ = false; }
  /// Begins a slip with the hand's stylus at `X_WS` and the tool's at `X_WS_tool`.
  void begin(const RigidTransform& X_WS, const RigidTransform& X_WS_tool);
  /// Returns the pose of the tool's stylus when the hand's is at `X_WS`.
  RigidTransform of(const RigidTransform& X_WS) const { return displaced(X_WS, 1.0); }
  /// Returns the motion of the tool's stylus over the next `h` [s], during which it returns towards the hand's.
  MotionSegment motion(const MotionSegment& hand, double now, double h);
  /// Accepts the step of the last motion(). No effect if there is no slip.
  void accept();

  void archive(math::StateArchive& state) { state(open_, by_W_, turn_S_, left_); }

 private:
  RigidTransform displaced(const RigidTransform& X_WS, double left) const;

  bool open_ = false;
  Vector3d by_W_ = Vector3d::Zero();    ///< [m]
  Vector3d turn_S_ = Vector3d::Zero();  ///< rotation vector in the stylus' axes [rad]
  double left_ = 1.0;                   ///< remaining fraction of both at the end of the step
};

}  // namespace spring_workbench::motion
