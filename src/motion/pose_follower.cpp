#include "spring_workbench/motion/pose_follower.h"

#include <cmath>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::motion {
namespace {

/// Fraction of a path of this length that is covered in `dt` [s].
double share(double path, double dt, double max_rate) {
  const double free = -std::expm1(-dt / PoseFollower::time_constant);
  return path * free > max_rate * dt ? max_rate * dt / path : free;
}

}  // namespace

const RigidTransform& PoseFollower::advance(double dt) {
  const Vector3d path = goal_.translation() - X_.translation();
  const Vector3d turn = math::turn_between(X_, goal_);
  if (path.norm() < arrived && turn.norm() < arrived) return X_ = goal_;
  const Quaterniond q(X_.linear() * math::exp_so3(share(turn.norm(), dt, max_turn_rate) * turn));
  X_ = make_transform(X_.translation() + share(path.norm(), dt, max_speed) * path, q);
  return X_;
}

}  // namespace spring_workbench::motion
