#pragma once

#include <deque>
#include <limits>

#include "spring_workbench/motion/frame_motion.h"

namespace spring_workbench {

/// One sample of a tracked frame: time [s] and pose.
struct PoseSample {
  double t = 0.0;
  RigidTransform X = RigidTransform::Identity();
};

/// The motion between two neighbouring samples: a cubic Hermite polynomial in position and in rotation vector from the
/// velocities at both (see doc/model.md).
class MotionSegment final : public FrameMotion {
 public:
  /// Rests at `X` from `begin` to `end` [s]; for ever where they are not given.
  explicit MotionSegment(const RigidTransform& X, double begin = -std::numeric_limits<double>::infinity(),
                         double end = std::numeric_limits<double>::infinity());
  /// From sample `a` to sample `b` (`a.t < b.t`) with the velocities at both; linear part in world axes,
  /// `w_*_B` the body rates in the body's own axes.
  MotionSegment(const PoseSample& a, const Vector3d& v_a, const Vector3d& w_a_B, const PoseSample& b,
                const Vector3d& v_b, const Vector3d& w_b_B);

  /// The motion of a frame C that stands at `X_BC` in this one, B, fixed to it.
  MotionSegment of_frame(const RigidTransform& X_BC) const;

  double begin() const;  ///< [s]
  double end() const;    ///< [s]; infinity for a frame at rest
  /// State at time `t` [s], begin() ≤ t ≤ end().
  MotionState at(double t) const;
  OwnAxesMotion in_own_axes(double t) const override;
  FrameForcing<Pack> forcing(const Pack& t, double gravity) const override;

 private:
  /// `u (c[0] + u (c[1] + …))` for u = 0 … 1 over the segment: what a vector adds to its value at the start.
  struct Polynomial {
    Vector3d c[3];
    static Polynomial cubic(const Vector3d& change, const Vector3d& slope_a, const Vector3d& slope_b);
    template <typename S>
    SPRING_WORKBENCH_INLINE Three<S> value(const S& u) const {
      return u * (three(c[0]) + u * (three(c[1]) + u * three(c[2])));
    }
    template <typename S>
    SPRING_WORKBENCH_INLINE Three<S> first(const S& u) const {
      return three(c[0]) + u * (2.0 * three(c[1]) + u * (3.0 * three(c[2])));
    }
    template <typename S>
    SPRING_WORKBENCH_INLINE Three<S> second(const S& u) const {
      return 2.0 * three(c[1]) + u * (6.0 * three(c[2]));
    }
  };

  /// Rotation from the start, body rates and angular acceleration.
  template <typename S>
  struct Turn {
    ThreeByThree<S> R;
    Three<S> w_B, alpha_B;
  };
  template <typename S>
  Turn<S> turn(const S& u, double per_second) const;
  /// What C feels where B feels `f`.
  FrameForcing<Pack> at_frame(const FrameForcing<Pack>& f) const;
  OwnAxesMotion of_samples(double t) const;
  FrameForcing<Pack> of_samples(const Pack& t, double gravity) const;

  RigidTransform X_a_;
  double begin_;
  double end_;
  bool moving_;
  bool turning_ = false;
  Polynomial position_;     ///< world axes [m]
  Polynomial rotation_;     ///< rotation vector from the pose at the start, in its axes [rad]; where turning
  bool elsewhere_ = false;  ///< the frame is not that of the samples, B, but C
  RigidTransform X_BC_ = RigidTransform::Identity();
};

/// The samples of one tracked frame, interpolated so that the motion passes through each of them and is C¹.
/// The velocity at a sample comes from it and its two neighbours (at an end of the motion: from the chord to the only
/// one); it is fixed when the first segment that uses it is asked for, so that a live track, whose newest sample is an
/// end, stays C¹ as well.
class PoseTrack {
 public:
  /// `dropout_after` [s]: a gap between samples longer than this holds the last pose at zero velocity until the next
  /// sample, where the motion goes on from the new pose.
  explicit PoseTrack(double dropout_after = 0.5);

  /// Adds a sample. Returns false, and leaves it out, when its stamp is not later than the newest one's by at least
  /// half a nanosecond. Throws InputError when the sample is not finite, is out of any range (|t| > 1e12 s, |p| > 1e9
  /// m) or its linear part is no rotation.
  bool push(const PoseSample& sample);

  bool empty() const;
  double begin() const;  ///< time of the oldest sample still held [s]
  double end() const;    ///< time of the newest sample [s]
  /// The segment that starts at or contains `t`, begin() ≤ t. At or after end(): at rest at the newest pose.
  /// The reference is good until the next call of a function that is not const.
  /// Throws std::logic_error when the track is empty or `t` lies before begin().
  const MotionSegment& segment(double t);
  /// Forgets samples that no segment at or after `t` needs.
  void forget_before(double t);
  void clear();

 private:
  struct Node {
    PoseSample sample;
    bool velocity_fixed = false;
    Vector3d v_W = Vector3d::Zero();  ///< [m/s]
    Vector3d w_B = Vector3d::Zero();  ///< body rates [rad/s]
  };

  bool joined(std::size_t k) const;          ///< sample k + 1 exists and follows sample k without a dropout
  const Node& with_velocity(std::size_t k);  ///< sample k must be joined to a neighbour
  MotionSegment make_segment(std::size_t k);

  double dropout_after_;
  std::deque<Node> nodes_;
  MotionSegment current_;  ///< the segment asked for last
  bool current_valid_ = false;
};

}  // namespace spring_workbench
