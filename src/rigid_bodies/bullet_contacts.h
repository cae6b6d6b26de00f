#pragma once

#include <vector>

#include "bullet_types.h"
#include "constants.h"

namespace spring_workbench::rigid_bodies {

/// A shape with a bounding box larger by contact_margin: Bullet asks for its contacts before it overlaps anything.
template <typename Shape>
class WithMargin final : public Shape {
 public:
  using Shape::Shape;
  void getAabb(const btTransform& X_WS, btVector3& min, btVector3& max) const override {
    Shape::getAabb(X_WS, min, max);
    const btVector3 margin(0.5 * contact_margin, 0.5 * contact_margin, 0.5 * contact_margin);
    min -= margin;
    max += margin;
  }
};

/// Finds the contacts of sleeping bodies, too: otherwise a body that is hit would be pushed into its support first.
class DispatcherForSleepers final : public btCollisionDispatcher {
 public:
  using btCollisionDispatcher::btCollisionDispatcher;
  bool needsCollision(const btCollisionObject* a, const btCollisionObject* b) override {
    return a->checkCollideWith(b) && b->checkCollideWith(a);
  }
  /// All the manifolds that there are, in this order.
  void set_order(const std::vector<btPersistentManifold*>& manifolds);

  bool contacts_missing = false;  ///< shapes overlap without a contact, or there was no room for a closed one
};

/// Bullet's configuration with contacts of boxes by `box_contacts`, and of all other shapes and planes by
/// `solid_contacts`; two cylinders are left to Bullet. A shape's user pointer is its `geometry::Solid`.
class ContactConfiguration final : public btDefaultCollisionConfiguration {
 public:
  ContactConfiguration() : btDefaultCollisionConfiguration(without_pools()) {}
  btCollisionAlgorithmCreateFunc* getCollisionAlgorithmCreateFunc(int proxy_a, int proxy_b) override;

 private:
  /// Pairs are allocated when they come near, not thousands in advance.
  static btDefaultCollisionConstructionInfo without_pools() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = 1;
    return info;
  }
  struct Create final : btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* a,
                                                   const btCollisionObjectWrapper* b) override;
  };
  Create create_;
};

}  // namespace spring_workbench::rigid_bodies
