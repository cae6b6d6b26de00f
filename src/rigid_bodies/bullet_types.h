#pragma once

#include <btBulletDynamicsCommon.h>

#include "spring_workbench/math/rigid_transform.h"
#include "spring_workbench/math/spatial.h"

namespace spring_workbench::rigid_bodies {

inline btVector3 to_bullet(const Vector3d& v) { return btVector3(v.x(), v.y(), v.z()); }
inline Vector3d from_bullet(const btVector3& v) { return Vector3d(v.x(), v.y(), v.z()); }
/// [linear; angular].
inline Vector6d both(const btVector3& linear, const btVector3& angular) {
  return (Vector6d() << from_bullet(linear), from_bullet(angular)).finished();
}

inline btTransform to_bullet(const RigidTransform& X) {
  const Matrix3d& R = X.linear();
  return btTransform(btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
                     to_bullet(Vector3d(X.translation())));
}

inline RigidTransform from_bullet(const btTransform& X) {
  RigidTransform out = RigidTransform::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out.linear()(row, column) = X.getBasis()[row][column];
  }
  out.translation() = from_bullet(X.getOrigin());
  return out;
}

/// One without mass may not: Bullet takes contacts of what cannot move for none.
inline void let_move(btRigidBody& body, bool may_move) {
  const double factor = may_move ? 1.0 : 0.0;
  body.setLinearFactor(btVector3(factor, factor, factor));
  body.setAngularFactor(factor);
}

}  // namespace spring_workbench::rigid_bodies
