#pragma once

#include "bullet_types.h"

namespace spring_workbench::rigid_bodies {

/// A box with a larger bounding box, by contact_margin, so that Bullet asks for its contacts before it overlaps
/// anything.
class MarginBox final : public btBoxShape {
 public:
  using btBoxShape::btBoxShape;
  void getAabb(const btTransform& X_WS, btVector3& least, btVector3& most) const override;
};

/// Bullet's configuration, but for contacts of boxes with boxes and planes, which are those of `box_contacts`, and
/// those of cylinders and meshes with planes, which are exact, too. A mesh's shape has the mesh for its user pointer.
class BoxContactConfiguration final : public btDefaultCollisionConfiguration {
 public:
  btCollisionAlgorithmCreateFunc* getCollisionAlgorithmCreateFunc(int proxy_a, int proxy_b) override;

 private:
  struct Create final : btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* a,
                                                   const btCollisionObjectWrapper* b) override;
  };
  Create create_;
};

}  // namespace spring_workbench::rigid_bodies
