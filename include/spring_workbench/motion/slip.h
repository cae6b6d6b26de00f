#pragma once

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// How far a tool has slipped in the hand: its stylus is not where the hand has it, and comes back (doc/model.md, "At
/// the limit").
class Slip {
 public:
  bool open() const { return open_; }
  void close() { open_ = false; }
  /// The tool's stylus is at `seen` where the hand has it at `X_WS`.
  void begin(const RigidTransform& X_WS, const RigidTransform& seen);
  /// The tool's stylus where the hand has it at `X_WS`.
  RigidTransform of(const RigidTransform& X_WS) const { return displaced(X_WS, 1.0); }
  /// The motion of the tool's stylus over the next `h` [s], on which it comes back.
  MotionSegment motion(const MotionSegment& hand, double now, double h);
  /// That step has been made; of no effect where it is not open.
  void accept();

  void exchange(math::StateArchive& state) { state(open_, by_W_, turn_S_, left_); }

 private:
  RigidTransform displaced(const RigidTransform& X_WS, double left) const;

  bool open_ = false;
  Vector3d by_W_ = Vector3d::Zero();    ///< [m]
  Vector3d turn_S_ = Vector3d::Zero();  ///< rotation vector in the stylus' axes [rad]
  double left_ = 1.0;                   ///< of both, at the end of the step
};

}  // namespace spring_workbench::motion
