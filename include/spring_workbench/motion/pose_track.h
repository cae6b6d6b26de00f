#pragma once

#include <deque>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench {

/// One sample of a tracked frame: time [s] and pose.
struct PoseSample {
  double t = 0.0;
  RigidTransform X = RigidTransform::Identity();
};

/// A frame's motion at one moment, in world axes: pose, velocity [m/s, rad/s] and acceleration [m/s², rad/s²].
struct MotionState {
  RigidTransform X = RigidTransform::Identity();
  Twist velocity;
  Twist acceleration;
};

/// The motion between two neighbouring samples: cubic Hermite in position and in rotation vector (see doc/model.md).
class MotionSegment {
 public:
  /// Rests at `X` for ever.
  explicit MotionSegment(const RigidTransform& X);
  /// From sample `a` to sample `b` (`a.t < b.t`) with the velocities at both; linear part in world axes,
  /// `w_*_B` the body rates in the body's own axes.
  MotionSegment(const PoseSample& a, const Vector3d& v_a, const Vector3d& w_a_B, const PoseSample& b,
                const Vector3d& v_b, const Vector3d& w_b_B);

  double begin() const;  ///< [s]
  double end() const;    ///< [s]; infinity for a frame at rest
  /// State at time `t` [s], begin() ≤ t ≤ end().
  MotionState at(double t) const;

 private:
  // …
};

/// The samples of one tracked frame, interpolated so that the motion passes through each of them and is C¹.
/// The velocity at a sample comes from three neighbouring samples; it is fixed when the first segment that uses it is asked
/// for, so that a live track (newest sample: one-sided) stays C¹ as well.
class PoseTrack {
 public:
  /// `dropout_after` [s]: a gap between samples longer than this holds the last pose at zero velocity until the next
  /// sample, where the motion goes on from the new pose.
  explicit PoseTrack(double dropout_after = 0.5);

  /// Adds a sample. Returns false, and leaves it out, when its stamp is not later than the newest one's.
  /// Throws InputError when the sample is not finite.
  bool push(const PoseSample& sample);

  bool empty() const;
  double begin() const;  ///< time of the oldest sample still held [s]
  double end() const;    ///< time of the newest sample [s]
  /// The segment that starts at or contains `t`, begin() ≤ t. At or after end(): at rest at the newest pose.
  const MotionSegment& segment(double t);
  /// Forgets samples that no segment at or after `t` needs.
  void forget_before(double t);
  void clear();
};

}  // namespace spring_workbench
