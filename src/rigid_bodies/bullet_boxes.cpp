// A derived btBoxShape brings its inline getPlane() with it, in which GCC 12 sees a plane without a value.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "bullet_boxes.h"

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>

#include <algorithm>
#include <vector>

#include "constants.h"
#include "spring_workbench/geometry/box_contacts.h"

namespace spring_workbench::rigid_bodies {
namespace {

geometry::OutlineBox outline_of(const btCollisionObjectWrapper& object) {
  const auto& box = static_cast<const btBoxShape&>(*object.getCollisionShape());
  const Vector3d half = from_bullet(box.getHalfExtentsWithMargin()) - Vector3d::Constant(contact_skin);
  return {from_bullet(object.getWorldTransform()), half, true};
}

bool is_plane(const btCollisionObjectWrapper& object) {
  return object.getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE;
}

std::vector<geometry::BoxContact> contacts_above(const btCollisionObjectWrapper& box,
                                                 const btCollisionObjectWrapper& plane) {
  const auto& shape = static_cast<const btStaticPlaneShape&>(*plane.getCollisionShape());
  const RigidTransform X_WP = from_bullet(plane.getWorldTransform());
  const Vector3d n_W = X_WP.linear() * from_bullet(shape.getPlaneNormal());
  return geometry::box_contacts(outline_of(box), n_W,
                                n_W.dot(X_WP.translation()) + shape.getPlaneConstant() - contact_skin, seen_from);
}

/// Contacts of a box with a box or a plane, in either order, found anew in every step; each begins with the impulses of
/// the one before that is nearest to it.
class BoxContacts final : public btActivatingCollisionAlgorithm {
 public:
  BoxContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
              const btCollisionObjectWrapper* b)
      : btActivatingCollisionAlgorithm(info, a, b),
        manifold_(m_dispatcher->getNewManifold(a->getCollisionObject(), b->getCollisionObject())) {
    manifold_->m_companionIdA = a->m_index;
    manifold_->m_companionIdB = b->m_index;
  }
  ~BoxContacts() override { m_dispatcher->releaseManifold(manifold_); }

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo&,
                        btManifoldResult* result) override {
    std::vector<btManifoldPoint> before;
    for (int i = 0; i < manifold_->getNumContacts(); ++i) before.push_back(manifold_->getContactPoint(i));
    manifold_->clearManifold();
    result->setPersistentManifold(manifold_);
    // Not by the result's own addContactPoint(), which takes near ones for one.
    for (const geometry::BoxContact& c : find(*a, *b)) {
      btManifoldPoint point = made(c, *a->getCollisionObject(), *b->getCollisionObject());
      point.m_index0 = a->m_index;
      point.m_index1 = b->m_index;
      take_impulses(before, point);
      manifold_->addManifoldPoint(point);
    }
  }
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1.0;  // of Bullet's continuous mode, which is not used
  }
  void getAllContactManifolds(btManifoldArray& all) override { all.push_back(manifold_); }

 private:
  static std::vector<geometry::BoxContact> find(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
    if (is_plane(b)) return contacts_above(a, b);
    if (!is_plane(a)) return geometry::box_contacts(outline_of(a), outline_of(b), seen_from);
    std::vector<geometry::BoxContact> contacts = contacts_above(b, a);
    for (geometry::BoxContact& c : contacts) {
      c.p_W += c.gap * c.n_W;
      c.n_W = -c.n_W;
    }
    return contacts;
  }
  static btManifoldPoint made(const geometry::BoxContact& c, const btCollisionObject& a, const btCollisionObject& b) {
    const btVector3 on_b = to_bullet(c.p_W), on_a = to_bullet(Vector3d(c.p_W + c.gap * c.n_W));
    btManifoldPoint point(a.getWorldTransform().invXform(on_a), b.getWorldTransform().invXform(on_b), to_bullet(c.n_W),
                          c.gap - 2.0 * contact_skin);
    point.m_positionWorldOnA = on_a;
    point.m_positionWorldOnB = on_b;
    point.m_combinedFriction = btManifoldResult::calculateCombinedFriction(&a, &b);
    point.m_combinedRestitution = btManifoldResult::calculateCombinedRestitution(&a, &b);
    return point;
  }
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
  const bool box_a = proxy_a == BOX_SHAPE_PROXYTYPE, box_b = proxy_b == BOX_SHAPE_PROXYTYPE;
  const bool plane_a = proxy_a == STATIC_PLANE_PROXYTYPE, plane_b = proxy_b == STATIC_PLANE_PROXYTYPE;
  if ((box_a || plane_a) && (box_b || plane_b) && !(plane_a && plane_b)) return &create_;
  return btDefaultCollisionConfiguration::getCollisionAlgorithmCreateFunc(proxy_a, proxy_b);
}

btCollisionAlgorithm* BoxesSeenEarly::Create::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                       const btCollisionObjectWrapper* a,
                                                                       const btCollisionObjectWrapper* b) {
  return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(BoxContacts))) BoxContacts(info, a, b);
}

}  // namespace spring_workbench::rigid_bodies
