#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace spring_workbench {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
/// A twist [linear; angular] or wrench [force; moment]: linear first, as in ROS and Pinocchio (Featherstone and Drake
/// put the angular part first).
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;  ///< linear map between vectors of type Vector6d

/// Pose of a frame B in a frame A, written `X_AB`: a point has `p_A = X_AB * p_B`. Lengths are in m.
using RigidTransform = Eigen::Isometry3d;

/// Velocity of a frame. The name of a variable says the axes: `V_WO_W` is the velocity of frame O in W, in the axes of
/// W. (In settings of the fork, `twist` is an angle of torsion instead.)
struct Twist {
  Vector3d linear = Vector3d::Zero();   ///< velocity of the origin [m/s]
  Vector3d angular = Vector3d::Zero();  ///< angular velocity [rad/s]
};

/// Force and moment at a frame. The name of a variable says the axes.
struct Wrench {
  Vector3d force = Vector3d::Zero();   ///< force [N]
  Vector3d moment = Vector3d::Zero();  ///< moment about the frame's origin [N·m]
};

/// Returns the pose with origin `p` [m] and rotation `q`, which need not be of unit length but must not be zero. The
/// constructor of Quaterniond takes w, x, y, z, whereas files, messages and Python have x, y, z, w.
inline RigidTransform make_transform(const Vector3d& p, const Quaterniond& q) {
  RigidTransform X = RigidTransform::Identity();
  X.linear() = q.normalized().toRotationMatrix();
  X.translation() = p;
  return X;
}

}  // namespace spring_workbench
