#pragma once

#include <deque>

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// The samples of one tracked frame and the C¹ motion that interpolates them. The velocity at a sample is computed from
/// the sample and its two neighbours (at an end of the motion: from the chord to the only neighbour). It is fixed when
/// the first segment that uses it is requested, so that a live track, whose newest sample is an end, stays C¹, too.
class PoseTrack {
 public:
  /// `dropout_after` [s]: after a gap between samples longer than this, the frame is at rest at the last pose until the
  /// next sample, at whose pose the motion continues.
  explicit PoseTrack(double dropout_after = 0.5);

  /// Adds a sample. Returns false, and ignores it, if its stamp is not later than the newest one by at least half a
  /// nanosecond. Throws InputError when the sample is not finite, is out of any range (|t| > 1e12 s, |p| > 1e9 m) or
  /// its linear part is not a rotation.
  bool push(const PoseSample& sample);

  bool empty() const { return nodes_.empty(); }             ///< whether it has no sample
  double begin() const { return nodes_.front().sample.t; }  ///< time of the oldest sample still held [s]
  double end() const { return nodes_.back().sample.t; }     ///< time of the newest sample [s]
  /// The segment that starts at or contains `t`, begin() ≤ t; at or after end(), at rest at the newest pose. The
  /// reference is valid until the next call of a non-const function. Throws std::logic_error if the track is empty or
  /// `t` is before begin().
  const MotionSegment& segment(double t);
  /// The segment at `t` without fixing velocities: the motion as known so far.
  MotionSegment provisional(double t) const;
  /// The pose at `t` as in provisional(); at a sample, exactly that of the sample.
  RigidTransform pose(double t) const;
  /// Stamp of the first sample later than `t` [s]; infinity if there is none.
  double next_after(double t) const;
  /// Forgets samples that no segment at or after `t` needs.
  void forget_before(double t);
  void clear();  ///< forgets all samples

  void exchange(math::StateArchive& state);  ///< saves or restores samples and velocities

 private:
  struct Node {
    PoseSample sample;
    bool velocity_fixed = false;
    Vector3d v_W = Vector3d::Zero();  ///< [m/s]
    Vector3d w_B = Vector3d::Zero();  ///< body rates [rad/s]
    void exchange(math::StateArchive& state) { state(sample, velocity_fixed, v_W, w_B); }
  };

  std::deque<Node>::const_iterator first_after(double t) const;
  std::size_t index_at(double t) const;     ///< index of the sample at or before `t`
  bool joined(std::size_t k) const;         ///< sample k + 1 exists and follows sample k without a dropout
  Node with_velocity(std::size_t k) const;  ///< sample k must be joined to a neighbour
  MotionSegment make_segment(std::size_t k) const;

  double dropout_after_;
  std::deque<Node> nodes_;
  MotionSegment current_;  ///< the segment requested last
  bool current_valid_ = false;
};

}  // namespace spring_workbench::motion
