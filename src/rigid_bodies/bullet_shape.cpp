#include "bullet_shape.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "bullet_contacts.h"
#include "constants.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::rigid_bodies {

BulletShape::BulletShape(const scene::Body& body, const RigidTransform& X_OB) {
  for (const geometry::Shape& shape : body.collision) {
    parts_.push_back(part_of(shape.geometry));
    compound_.addChildShape(to_bullet(RigidTransform(X_OB.inverse() * shape.X_OS)), parts_.back().get());
    solids_.push_back(std::make_unique<const geometry::Solid>(shape.geometry));
    parts_.back()->setUserPointer(const_cast<geometry::Solid*>(solids_.back().get()));  // is only read
  }
}

double BulletShape::fraction_before(const BulletShape& a, const RigidTransform& X0_WA, const RigidTransform& X1_WA,
                                    double moved, const BulletShape& b, const RigidTransform& X_WB, double allowed) {
  const Vector3d turn = math::turn_between(X0_WA, X1_WA);
  const double looks = std::max(1.0, std::ceil(moved / unswept));
  for (double look = 1.0; look <= looks; ++look) {
    if (depth(a, math::between(X0_WA, X1_WA, turn, look / looks), b, X_WB) > allowed) return (look - 0.5) / looks;
  }
  return 1.0;
}

double BulletShape::depth(const BulletShape& a, const RigidTransform& X_WA, const BulletShape& b,
                          const RigidTransform& X_WB) {
  double depth = 0.0;
  for (int i = 0; i < a.compound_.getNumChildShapes(); ++i) {
    for (int k = 0; k < b.compound_.getNumChildShapes(); ++k) {
      const btCollisionShape &own = *a.compound_.getChildShape(i), &other = *b.compound_.getChildShape(k);
      const auto& own_solid = *static_cast<const geometry::Solid*>(own.getUserPointer());
      const auto& other_solid = *static_cast<const geometry::Solid*>(other.getUserPointer());
      const bool alike = own.getShapeType() == other.getShapeType();
      const bool by_outline = alike && own.getShapeType() == BOX_SHAPE_PROXYTYPE;
      const bool by_bullet = alike && own.getShapeType() == CYLINDER_SHAPE_PROXYTYPE;
      if (by_outline || by_bullet) continue;
      for (const geometry::BoxContact& c :
           geometry::solid_contacts(own_solid, X_WA * from_bullet(a.compound_.getChildTransform(i)), other_solid,
                                    X_WB * from_bullet(b.compound_.getChildTransform(k)), 0.0, unswept_of_free)) {
        depth = std::max(depth, -c.gap);
      }
    }
  }
  return depth;
}

std::unique_ptr<btCollisionShape> BulletShape::part_of(const geometry::Geometry& geometry) {
  if (const auto* box = std::get_if<geometry::Box>(&geometry)) {
    const Vector3d half = 0.5 * box->size + Vector3d::Constant(contact_skin);
    return std::make_unique<WithMargin<btBoxShape>>(to_bullet(half));
  }
  if (const auto* sphere = std::get_if<geometry::Sphere>(&geometry)) {
    return std::make_unique<WithMargin<btSphereShape>>(sphere->radius + contact_skin);
  }
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&geometry)) {
    const double r = cylinder->radius + contact_skin;
    return std::make_unique<WithMargin<btCylinderShapeZ>>(btVector3(r, r, 0.5 * cylinder->length + contact_skin));
  }
  // Of a mesh Bullet sees the box around it.
  const Eigen::AlignedBox3d extent = geometry::bounding_box(geometry);
  auto hull = std::make_unique<WithMargin<btConvexHullShape>>();
  for (const Vector3d& corner : geometry::corners(0.5 * extent.sizes())) {
    hull->addPoint(to_bullet(Vector3d(extent.center() + corner)), false);
  }
  hull->recalcLocalAabb();
  hull->setMargin(contact_skin);
  return hull;
}

}  // namespace spring_workbench::rigid_bodies
