#pragma once

#include "spring_workbench/math/pack.h"

namespace spring_workbench::motion {

/// A frame's motion at one moment, in world axes: pose, velocity [m/s, rad/s] and acceleration [m/s², rad/s²].
struct MotionState {
  RigidTransform X = RigidTransform::Identity();
  Twist velocity;
  Twist acceleration;
};

/// The same with the angular parts as body rates, in the frame's own axes.
struct OwnAxesMotion {
  RigidTransform X = RigidTransform::Identity();  ///< X_WB
  Vector3d v_W = Vector3d::Zero();                ///< [m/s]
  Vector3d a_W = Vector3d::Zero();                ///< [m/s²]
  Vector3d w_B = Vector3d::Zero();                ///< [rad/s]
  Vector3d alpha_B = Vector3d::Zero();            ///< [rad/s²]
};

/// How a frame B moves and what it feels, in its own axes, at one moment or at several.
template <typename S>
struct FrameForcing {
  math::ThreeByThree<S> R_WB;
  math::Three<S> v_B;      ///< of the origin [m/s]
  math::Three<S> w_B;      ///< [rad/s]
  math::Three<S> alpha_B;  ///< [rad/s²]
  math::Three<S> a_B;      ///< of the origin, less gravity [m/s²]
};

/// How a frame moves: twice differentiable in time, over the times that are asked for.
class FrameMotion {
 public:
  virtual OwnAxesMotion in_own_axes(double t) const = 0;
  /// At the times `t` [s], with `gravity` [m/s²] along −z of world.
  virtual FrameForcing<math::Pack> forcing(const math::Pack& t, double gravity) const = 0;

 protected:
  ~FrameMotion() = default;
};

}  // namespace spring_workbench::motion
