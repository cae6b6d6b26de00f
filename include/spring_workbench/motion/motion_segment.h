#pragma once

#include <array>
#include <limits>

#include "spring_workbench/math/pack.h"
#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::motion {

/// Motion of a frame at one moment, in world axes.
struct MotionState {
  RigidTransform X = RigidTransform::Identity();  ///< pose
  Twist velocity;                                 ///< velocity [m/s, rad/s]
  Twist acceleration;                             ///< acceleration [m/s², rad/s²]
};

/// Motion of a frame B at one moment, with angular velocity and acceleration in its own axes.
struct BodyRateState {
  RigidTransform X = RigidTransform::Identity();  ///< X_WB
  Vector3d v_W = Vector3d::Zero();                ///< velocity of the origin, world axes [m/s]
  Vector3d a_W = Vector3d::Zero();                ///< acceleration of the origin, world axes [m/s²]
  Vector3d w_B = Vector3d::Zero();                ///< angular velocity, axes of B [rad/s]
  Vector3d alpha_B = Vector3d::Zero();            ///< angular acceleration, axes of B [rad/s²]
};

/// Velocity and acceleration of a frame B in its own axes, at one time (`S` double) or at several (`S` a math::Pack).
template <typename S>
struct BodyFrameRates {
  math::Mat3x3<S> R_WB;   ///< rotation: columns are the axes of B in W
  math::Vec3<S> v_B;      ///< velocity of the origin [m/s]
  math::Vec3<S> w_B;      ///< angular velocity [rad/s]
  math::Vec3<S> alpha_B;  ///< angular acceleration [rad/s²]
  math::Vec3<S> a_B;      ///< proper acceleration: the acceleration of the origin less gravity [m/s²]
};

/// Motion of a frame as a function of time, such as the handle's. It is twice differentiable over the requested times.
class Trajectory {
 public:
  virtual BodyRateState body_rate_state(double t) const = 0;  ///< returns the motion at time `t` [s]
  /// Returns the motion at several times `t` [s], with `gravity` [m/s²] along −z of world.
  virtual BodyFrameRates<math::Pack> body_frame_rates(const math::Pack& t, double gravity) const = 0;

 protected:
  ~Trajectory() = default;
};

/// One sample of a tracked frame: time [s] and pose.
struct PoseSample {
  double t = 0.0;                                 ///< time [s]
  RigidTransform X = RigidTransform::Identity();  ///< pose of the frame; positions in m

  /// Saves or restores both fields.
  void archive(math::StateArchive& state) { state(t, X); }
};

/// The motion between two neighbouring samples: cubic Hermite interpolation of position and rotation vector, with given
/// velocities at both ends (see doc/model.md).
class MotionSegment final : public Trajectory {
 public:
  /// A frame at rest at the pose `X` from `begin` to `end` [s]; by default forever.
  explicit MotionSegment(const RigidTransform& X, double begin = -std::numeric_limits<double>::infinity(),
                         double end = std::numeric_limits<double>::infinity());
  /// A motion from sample `a` to sample `b`, `a.t < b.t`, with given velocities at both: `v_…` in world axes [m/s] and
  /// `w_…_B` in the axes of the frame [rad/s].
  MotionSegment(const PoseSample& a, const Vector3d& v_a, const Vector3d& w_a_B, const PoseSample& b,
                const Vector3d& v_b, const Vector3d& w_b_B);

  /// Returns the motion of a frame C that is fixed to the frame B of this motion at the pose `X_BC`.
  MotionSegment of_frame(const RigidTransform& X_BC) const;

  double begin() const { return begin_; }  ///< time of the start [s]
  double end() const { return end_; }      ///< time of the end [s]; infinity for one that rests for good
  /// Returns the motion at time `t` [s], begin() ≤ t ≤ end(), in world axes.
  MotionState at(double t) const;
  BodyRateState body_rate_state(double t) const override;
  BodyFrameRates<math::Pack> body_frame_rates(const math::Pack& t, double gravity) const override;
  /// Returns whether this frame rests, and `next` is at a different pose at time `t` [s].
  bool rests_apart_from(const MotionSegment& next, double t) const {
    return !moving_ && at(t).X.matrix() != next.at(t).X.matrix();
  }

  /// Saves or restores the segment.
  void archive(math::StateArchive& state) {
    state(X_a_, begin_, end_, moving_, turning_, position_, rotation_, has_offset_, X_BC_);
  }

 private:
  /// `u (c[0] + u (c[1] + …))` for u = 0 … 1 over the segment: the change of a vector from its value at the start.
  struct Polynomial {
    std::array<Vector3d, 3> c{{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}};
    void archive(math::StateArchive& state) { state(c); }
    static Polynomial cubic(const Vector3d& change, const Vector3d& slope_a, const Vector3d& slope_b);
    template <typename S>
    SPRING_WORKBENCH_INLINE math::Vec3<S> value(const S& u) const {
      return u * (math::vec3(c[0]) + u * (math::vec3(c[1]) + u * math::vec3(c[2])));
    }
    template <typename S>
    SPRING_WORKBENCH_INLINE math::Vec3<S> first(const S& u) const {
      return math::vec3(c[0]) + u * (2.0 * math::vec3(c[1]) + u * (3.0 * math::vec3(c[2])));
    }
    template <typename S>
    SPRING_WORKBENCH_INLINE math::Vec3<S> second(const S& u) const {
      return 2.0 * math::vec3(c[1]) + u * (6.0 * math::vec3(c[2]));
    }
  };

  /// Rotation from the start, body rates and angular acceleration.
  template <typename S>
  struct Turn {
    math::Mat3x3<S> R;
    math::Vec3<S> w_B, alpha_B;
  };
  template <typename S>
  Turn<S> turn(const S& u, double per_second) const;
  /// The motion of C, given that of B.
  BodyFrameRates<math::Pack> at_frame(const BodyFrameRates<math::Pack>& f) const;
  BodyRateState of_samples(double t) const;
  BodyFrameRates<math::Pack> of_samples(const math::Pack& t, double gravity) const;

  RigidTransform X_a_;
  double begin_;
  double end_;
  bool moving_;
  bool turning_ = false;
  Polynomial position_;      ///< world axes [m]
  Polynomial rotation_;      ///< rotation vector from the pose at the start, in its axes [rad]; only if `turning_`
  bool has_offset_ = false;  ///< the frame is C, not the frame B of the samples
  RigidTransform X_BC_ = RigidTransform::Identity();
};

}  // namespace spring_workbench::motion
