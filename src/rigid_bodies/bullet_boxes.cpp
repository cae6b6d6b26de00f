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

/// The point of a cylinder or a mesh that lies furthest along a direction, both in the shape's frame.
Vector3d furthest(const btCollisionShape& shape, const Vector3d& along_S) {
  if (shape.getShapeType() == CYLINDER_SHAPE_PROXYTYPE) {
    const Vector3d half = from_bullet(static_cast<const btCylinderShapeZ&>(shape).getHalfExtentsWithMargin());
    const double size = along_S.head<2>().norm();
    Vector3d p(0.0, 0.0, std::copysign(half.z() - contact_skin, along_S.z()));
    if (size > 0.0) p.head<2>() = (half.x() - contact_skin) / size * along_S.head<2>();
    return p;
  }
  const auto& mesh = *static_cast<const geometry::TriangleMesh*>(shape.getUserPointer());
  return *std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                           [&](const Vector3d& a, const Vector3d& b) { return a.dot(along_S) < b.dot(along_S); });
}

/// Up to four of the contacts with a plane: the deepest, the one furthest from it, and on either side of the line
/// between them the one furthest from that.
std::vector<geometry::BoxContact> spanning(const std::vector<geometry::BoxContact>& all) {
  const auto best_by = [&](const auto& score) {
    return *std::max_element(all.begin(), all.end(), [&](const auto& a, const auto& b) { return score(a) < score(b); });
  };
  if (all.empty()) return {};
  const geometry::BoxContact deepest = best_by([](const auto& c) { return -c.gap; });
  const auto from_deepest = [&](const geometry::BoxContact& c) { return Vector3d(c.p_W - deepest.p_W); };
  const geometry::BoxContact across = best_by([&](const auto& c) { return from_deepest(c).norm(); });
  const Vector3d aside_W = deepest.n_W.cross(from_deepest(across));
  std::vector<geometry::BoxContact> kept{deepest};
  if (from_deepest(across).norm() < contact_skin) return kept;
  kept.push_back(across);
  for (const double side : {1.0, -1.0}) {
    const auto aside = [&](const auto& c) { return side * aside_W.dot(from_deepest(c)) / aside_W.norm(); };
    const geometry::BoxContact widest = best_by(aside);
    if (aside(widest) > contact_skin) kept.push_back(widest);
  }
  return kept;
}

/// Contacts of a cylinder or a mesh above the half-space `n · x < height`: of the points that lie furthest down, and
/// furthest down with a slope to one of eight sides. So what lands almost flush lands with all of its face.
std::vector<geometry::BoxContact> contacts_of_points(const btCollisionObjectWrapper& body, const Vector3d& n_W,
                                                     double height, double reach) {
  const RigidTransform X_WS = from_bullet(body.getWorldTransform());
  const Vector3d u_W = X_WS.linear().col(std::abs(n_W.dot(X_WS.linear().col(0))) < 0.7 ? 0 : 1).cross(n_W).normalized();
  std::vector<geometry::BoxContact> found;
  for (int i = 0; i <= 8; ++i) {
    const double turn = 0.25 * M_PI * i;
    const Vector3d side_W = std::cos(turn) * u_W + std::sin(turn) * n_W.cross(u_W);
    const Vector3d along_W = i < 8 ? Vector3d(slope_of_landing * side_W - n_W) : Vector3d(-n_W);
    const Vector3d p_W = X_WS * furthest(*body.getCollisionShape(), X_WS.linear().transpose() * along_W);
    const double gap = n_W.dot(p_W) - height;
    if (gap < reach) found.push_back({p_W - gap * n_W, n_W, gap});
  }
  return spanning(found);
}

std::vector<geometry::BoxContact> contacts_above(const btCollisionObjectWrapper& body,
                                                 const btCollisionObjectWrapper& plane, double reach) {
  const auto& shape = static_cast<const btStaticPlaneShape&>(*plane.getCollisionShape());
  const RigidTransform X_WP = from_bullet(plane.getWorldTransform());
  const Vector3d n_W = X_WP.linear() * from_bullet(shape.getPlaneNormal());
  const double height = n_W.dot(X_WP.translation()) + shape.getPlaneConstant() - contact_skin;
  if (body.getCollisionShape()->getShapeType() == BOX_SHAPE_PROXYTYPE) {
    return geometry::box_contacts(outline_of(body), n_W, height, reach);
  }
  return contacts_of_points(body, n_W, height, reach);
}

/// Contact margin of two bodies [m]: at least their approach in a step.
double reach_of(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, double h) {
  double speed = 0.0;
  for (const btCollisionObjectWrapper* w : {&a, &b}) {
    const btRigidBody* body = btRigidBody::upcast(w->getCollisionObject());
    if (body == nullptr || body->isStaticObject()) continue;
    btVector3 centre;
    btScalar radius = 0.0;
    body->getCollisionShape()->getBoundingSphere(centre, radius);
    speed += body->getLinearVelocity().length() + body->getAngularVelocity().length() * (centre.length() + radius);
  }
  return std::max(contact_margin, h * speed);
}

/// Contacts of boxes with each other, and of a box, a cylinder or a mesh with a plane, in either order, found anew in
/// every step; each begins with the impulses of the one before that is nearest to it.
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

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                        const btDispatcherInfo& info, btManifoldResult* result) override {
    std::vector<btManifoldPoint> before;
    for (int i = 0; i < manifold_->getNumContacts(); ++i) before.push_back(manifold_->getContactPoint(i));
    manifold_->clearManifold();
    result->setPersistentManifold(manifold_);
    // Not by the result's own addContactPoint(), which takes near ones for one.
    for (const geometry::BoxContact& c : find(*a, *b, reach_of(*a, *b, info.m_timeStep))) {
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
  static std::vector<geometry::BoxContact> find(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                                                double reach) {
    if (is_plane(b)) return contacts_above(a, b, reach);
    if (!is_plane(a)) return geometry::box_contacts(outline_of(a), outline_of(b), reach);
    std::vector<geometry::BoxContact> contacts = contacts_above(b, a, reach);
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

void MarginBox::getAabb(const btTransform& X_WS, btVector3& least, btVector3& most) const {
  btBoxShape::getAabb(X_WS, least, most);
  const btVector3 more(0.5 * contact_margin, 0.5 * contact_margin, 0.5 * contact_margin);
  least -= more;
  most += more;
}

btCollisionAlgorithmCreateFunc* BoxContactConfiguration::getCollisionAlgorithmCreateFunc(int proxy_a, int proxy_b) {
  const auto with_plane = [](int a, int b) {
    return b == STATIC_PLANE_PROXYTYPE && (a == BOX_SHAPE_PROXYTYPE || a == CYLINDER_SHAPE_PROXYTYPE ||
                                           a == CONVEX_HULL_SHAPE_PROXYTYPE || a == GIMPACT_SHAPE_PROXYTYPE);
  };
  const bool boxes = proxy_a == BOX_SHAPE_PROXYTYPE && proxy_b == BOX_SHAPE_PROXYTYPE;
  if (boxes || with_plane(proxy_a, proxy_b) || with_plane(proxy_b, proxy_a)) return &create_;
  // A movable mesh meets what is convex like a fixed one, triangle by triangle.
  const auto as_fixed = [](int proxy) {
    return proxy == GIMPACT_SHAPE_PROXYTYPE ? static_cast<int>(TRIANGLE_MESH_SHAPE_PROXYTYPE) : proxy;
  };
  return btDefaultCollisionConfiguration::getCollisionAlgorithmCreateFunc(as_fixed(proxy_a), as_fixed(proxy_b));
}

btCollisionAlgorithm* BoxContactConfiguration::Create::CreateCollisionAlgorithm(
    btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b) {
  return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(BoxContacts))) BoxContacts(info, a, b);
}

}  // namespace spring_workbench::rigid_bodies
