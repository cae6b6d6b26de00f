// A derived btBoxShape brings its inline getPlane() with it, in which GCC 12 sees a plane without a value.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include "bullet_boxes.h"

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>

#include <algorithm>
#include <vector>

#include "box_contacts.h"
#include "bullet_shape.h"

namespace spring_workbench {
namespace {

OutlineBox outline_of(const btCollisionObjectWrapper& object) {
  const auto& box = static_cast<const btBoxShape&>(*object.getCollisionShape());
  const Vector3d half = from_bullet(box.getHalfExtentsWithMargin()) - Vector3d::Constant(contact_skin);
  return {from_bullet(object.getWorldTransform()), half, true};
}

/// Contacts of two boxes, found anew in every step; each begins with the impulses of the one before that is nearest to it.
class BoxBox final : public btActivatingCollisionAlgorithm {
 public:
  BoxBox(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
         const btCollisionObjectWrapper* b)
      : btActivatingCollisionAlgorithm(info, a, b),
        manifold_(m_dispatcher->getNewManifold(a->getCollisionObject(), b->getCollisionObject())) {}
  ~BoxBox() override { m_dispatcher->releaseManifold(manifold_); }

  void processCollision(const btCollisionObjectWrapper* object_a, const btCollisionObjectWrapper* object_b,
                        const btDispatcherInfo&, btManifoldResult* result) override {
    const OutlineBox a = outline_of(*object_a), b = outline_of(*object_b);
    const double from = std::min({seen_from, a.half.minCoeff(), b.half.minCoeff()});
    std::vector<btManifoldPoint> before;
    for (int i = 0; i < manifold_->getNumContacts(); ++i) before.push_back(manifold_->getContactPoint(i));
    manifold_->clearManifold();
    manifold_->setContactBreakingThreshold(from);
    result->setPersistentManifold(manifold_);
    for (const BoxContact& c : box_contacts(a, b, from)) {
      result->addContactPoint(to_bullet(c.n_W), to_bullet(c.p_W), c.gap - 2.0 * contact_skin);
    }
    for (int i = 0; i < manifold_->getNumContacts(); ++i) take_impulses(before, manifold_->getContactPoint(i));
  }
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1.0;  // of Bullet's continuous mode, which is not used
  }
  void getAllContactManifolds(btManifoldArray& all) override { all.push_back(manifold_); }

 private:
  static void take_impulses(std::vector<btManifoldPoint>& before, btManifoldPoint& point) {
    const auto nearest = std::min_element(before.begin(), before.end(), [&](const auto& x, const auto& y) {
      return (x.m_localPointA - point.m_localPointA).length2() < (y.m_localPointA - point.m_localPointA).length2();
    });
    if (nearest == before.end()) return;
    point.m_appliedImpulse = nearest->m_appliedImpulse;
    point.m_appliedImpulseLateral1 = nearest->m_appliedImpulseLateral1;
    point.m_appliedImpulseLateral2 = nearest->m_appliedImpulseLateral2;
    before.erase(nearest);
  }
  btPersistentManifold* manifold_;
};

}  // namespace

void SeenBox::getAabb(const btTransform& X_WS, btVector3& least, btVector3& most) const {
  btBoxShape::getAabb(X_WS, least, most);
  const btVector3 more(0.5 * seen_from, 0.5 * seen_from, 0.5 * seen_from);
  least -= more;
  most += more;
}

btCollisionAlgorithmCreateFunc* BoxesSeenEarly::getCollisionAlgorithmCreateFunc(int proxy_a, int proxy_b) {
  if (proxy_a == BOX_SHAPE_PROXYTYPE && proxy_b == BOX_SHAPE_PROXYTYPE) return &create_;
  return btDefaultCollisionConfiguration::getCollisionAlgorithmCreateFunc(proxy_a, proxy_b);
}

btCollisionAlgorithm* BoxesSeenEarly::Create::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                       const btCollisionObjectWrapper* a,
                                                                       const btCollisionObjectWrapper* b) {
  return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(BoxBox))) BoxBox(info, a, b);
}

}  // namespace spring_workbench
