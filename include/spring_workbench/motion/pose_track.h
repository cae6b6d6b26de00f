#pragma once

#include <deque>

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// The samples of one tracked frame and the C¹ motion that interpolates them (doc/model.md). The velocity at a sample
/// is computed from the sample and its two neighbours or, at an end of the motion, from the chord to its only
/// neighbour. The velocity is frozen when a segment first uses it. Later samples therefore do not change motion that
/// has been handed out, and the motion of a live track, whose newest sample is always an end, stays C¹.
class PoseTrack {
 public:
  /// `dropout_after` [s], > 0: if the gap between two samples is longer, the frame rests at the first pose until the
  /// time of the second, and the motion continues from there.
  explicit PoseTrack(double dropout_after = 0.5);

  /// Adds a sample. Returns false, and ignores the sample, if it is not later than the newest one by at least half a
  /// nanosecond. Throws InputError if the sample is not finite, is out of range (|t| > 1e12 s, a coordinate beyond ±1e9
  /// m) or its linear part is not a rotation.
  bool push(const PoseSample& sample);

  bool empty() const { return nodes_.empty(); }             ///< whether the track has no sample
  double begin() const { return nodes_.front().sample.t; }  ///< time of the oldest sample kept [s]; not if empty()
  double end() const { return nodes_.back().sample.t; }     ///< time of the newest sample [s]; not if empty()
  /// Returns the segment that starts at or contains the time `t` [s], begin() ≤ t, and freezes its velocities. From
  /// end() on, the segment rests at the newest pose. The reference is valid until the next call of a non-const
  /// function. Throws std::logic_error if the track is empty or `t` is before begin().
  const MotionSegment& segment(double t);
  /// Returns the segment at time `t` [s] as known so far, without freezing its velocities.
  MotionSegment provisional(double t) const;
  /// Returns the pose of provisional() at time `t` [s]. At a sample, it is exactly the pose of the sample.
  RigidTransform pose(double t) const;
  /// Returns the time of the first sample later than `t` [s], or infinity if there is none.
  double next_after(double t) const;
  /// Forgets samples that no segment at or after the time `t` [s] needs.
  void forget_before(double t);
  void clear();  ///< forgets all samples

  void archive(math::StateArchive& state);  ///< saves or restores samples and velocities

 private:
  struct Node {
    PoseSample sample;
    bool velocity_fixed = false;
    Vector3d v_W = Vector3d::Zero();  ///< [m/s]
    Vector3d w_B = Vector3d::Zero();  ///< body rates [rad/s]
    void archive(math::StateArchive& state) { state(sample, velocity_fixed, v_W, w_B); }
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
