#include "bullet_shape.h"

#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <algorithm>
#include <type_traits>
#include <variant>

#include "bullet_boxes.h"
#include "constants.h"

namespace spring_workbench::rigid_bodies {
namespace {

/// Whether every vertex lies behind every triangle's plane.
bool is_convex(const geometry::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : mesh.vertices) box.extend(v);
  const double tolerance = 1e-6 * box.diagonal().norm();
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Eigen::Vector3i& t) {
    const Vector3d& a = mesh.corner(t, 0);
    const Vector3d n = (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a);
    if (n.isZero(0.0)) return true;
    const Vector3d unit = n.normalized();
    return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                       [&](const Vector3d& v) { return unit.dot(v - a) <= tolerance; });
  });
}

}  // namespace

BulletShape::BulletShape(const scene::Body& body, const RigidTransform& X_OB) {
  for (const geometry::Shape& shape : body.collision) {
    add(shape, body.movable, to_bullet(RigidTransform(X_OB.inverse() * shape.X_OS)));
  }
}

void BulletShape::add(const geometry::Shape& shape, bool movable, const btTransform& X_BS) {
  const auto keep = [&](std::unique_ptr<btCollisionShape> part) {
    compound_.addChildShape(X_BS, part.get());
    parts_.push_back(std::move(part));
  };
  std::visit(
      [&](const auto& g) {
        using G = std::decay_t<decltype(g)>;
        if constexpr (std::is_same_v<G, geometry::Box>) {
          keep(std::make_unique<MarginBox>(to_bullet(Vector3d(0.5 * g.size + Vector3d::Constant(contact_skin)))));
        } else if constexpr (std::is_same_v<G, geometry::Sphere>) {
          keep(std::make_unique<btSphereShape>(g.radius + contact_skin));
        } else if constexpr (std::is_same_v<G, geometry::Cylinder>) {
          const double r = g.radius + contact_skin;
          keep(std::make_unique<btCylinderShapeZ>(btVector3(r, r, 0.5 * g.length + contact_skin)));
        } else {
          add_mesh(*g, movable, X_BS);
        }
      },
      shape.geometry);
}

void BulletShape::add_mesh(const geometry::TriangleMesh& mesh, bool movable, const btTransform& X_BS) {
  std::unique_ptr<btCollisionShape> part;
  if (is_convex(mesh)) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vector3d& v : mesh.vertices) hull->addPoint(to_bullet(v), false);
    hull->recalcLocalAabb();
    hull->optimizeConvexHull();
    part = std::move(hull);
  } else {
    auto triangles = std::make_unique<btTriangleMesh>();
    for (const Eigen::Vector3i& t : mesh.triangles) {
      triangles->addTriangle(to_bullet(mesh.corner(t, 0)), to_bullet(mesh.corner(t, 1)), to_bullet(mesh.corner(t, 2)));
    }
    if (movable) {
      auto concave = std::make_unique<btGImpactMeshShape>(triangles.get());
      concave->setMargin(contact_skin);
      concave->updateBound();
      part = std::move(concave);
    } else {
      part = std::make_unique<btBvhTriangleMeshShape>(triangles.get(), true);
    }
    meshes_.push_back(std::move(triangles));
  }
  part->setMargin(contact_skin);
  part->setUserPointer(const_cast<geometry::TriangleMesh*>(&mesh));  // is only read
  compound_.addChildShape(X_BS, part.get());
  parts_.push_back(std::move(part));
}

}  // namespace spring_workbench::rigid_bodies
