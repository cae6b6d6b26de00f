#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace spring_workbench {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;  ///< [linear; angular] or [force; moment]
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Pose of a frame B in a frame A, written `X_AB`: `p_A = X_AB * p_B`. Lengths in m.
using RigidTransform = Eigen::Isometry3d;

/// Velocity of a frame: `linear` [m/s] of its origin and `angular` [rad/s]; the name says in which axes, `V_WO_W`.
struct Twist {
  Vector3d linear = Vector3d::Zero();   ///< velocity of the origin [m/s]
  Vector3d angular = Vector3d::Zero();  ///< angular velocity [rad/s]
};

/// Force [N] and moment [N·m] about a frame's origin; the name says in which axes.
struct Wrench {
  Vector3d force = Vector3d::Zero();   ///< [N]
  Vector3d moment = Vector3d::Zero();  ///< about the origin [N·m]
};

/// The pose with rotation `q` (need not be of unit length; must not be zero) and origin `p` [m].
inline RigidTransform make_transform(const Quaterniond& q, const Vector3d& p) {
  RigidTransform X = RigidTransform::Identity();
  X.linear() = q.normalized().toRotationMatrix();
  X.translation() = p;
  return X;
}

}  // namespace spring_workbench
