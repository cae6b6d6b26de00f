#pragma once

#include <memory>
#include <vector>

#include "bullet_types.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::rigid_bodies {

/// Every shape is larger by this all round [m], and contact is closed where two of them overlap by twice as much: so
/// that the solver sees a contact before it closes.

/// A body's collision shapes as Bullet's, in a frame B that `X_OB` places in the object frame.
class BulletShape {
 public:
  BulletShape(const scene::Body& body, const RigidTransform& X_OB);

  btCollisionShape* get() { return &compound_; }

 private:
  void add(const geometry::Shape& shape, bool movable, const btTransform& X_BS);
  void add_mesh(const geometry::TriangleMesh& mesh, bool movable, const btTransform& X_BS);

  btCompoundShape compound_;
  std::vector<std::unique_ptr<btCollisionShape>> parts_;
  std::vector<std::unique_ptr<btTriangleMesh>> meshes_;
};

}  // namespace spring_workbench::rigid_bodies
