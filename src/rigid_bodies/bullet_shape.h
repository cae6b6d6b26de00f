#pragma once

#include <memory>
#include <vector>

#include "bullet_types.h"
#include "spring_workbench/geometry/solid_contacts.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::rigid_bodies {

/// A body's collision shapes as Bullet's, in a frame B that `X_OB` places in the object frame.
class BulletShape {
 public:
  BulletShape(const scene::Body& body, const RigidTransform& X_OB);

  btCollisionShape* get() { return &compound_; }
  /// Fraction of the straight path of the solids of `a`, of which no point that may touch moves more than `moved`,
  /// before they are deeper than `allowed` in those of `b`, or 1; without pairs of boxes and pairs of cylinders. [m]
  static double fraction_before(const BulletShape& a, const RigidTransform& X0_WA, const RigidTransform& X1_WA,
                                double moved, const BulletShape& b, const RigidTransform& X_WB, double allowed);

 private:
  static double depth(const BulletShape& a, const RigidTransform& X_WA, const BulletShape& b,
                      const RigidTransform& X_WB);
  static std::unique_ptr<btCollisionShape> part_of(const geometry::Geometry& geometry);

  btCompoundShape compound_;
  std::vector<std::unique_ptr<btCollisionShape>> parts_;
  std::vector<std::unique_ptr<const geometry::Solid>> solids_;  ///< the parts' user pointers
};

}  // namespace spring_workbench::rigid_bodies
