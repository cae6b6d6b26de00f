// A derived btBoxShape brings its inline getPlane() with it, in which GCC 12 sees a plane without a value.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "bullet_contacts.h"

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "constants.h"
#include "spring_workbench/geometry/contact_reduction.h"
#include "spring_workbench/geometry/moving_solids.h"
#include "spring_workbench/geometry/solid_contacts.h"

namespace spring_workbench::rigid_bodies {
namespace {

geometry::OutlineBox outline_of(const btCollisionObjectWrapper& object) {
  const auto& box = static_cast<const btBoxShape&>(*object.getCollisionShape());
  const Vector3d half = from_bullet(box.getHalfExtentsWithMargin()) - Vector3d::Constant(contact_skin);
  return {from_bullet(object.getWorldTransform()), half, true};
}

bool is(const btCollisionObjectWrapper& object, int type) { return object.getCollisionShape()->getShapeType() == type; }
bool is_plane(const btCollisionObjectWrapper& object) { return is(object, STATIC_PLANE_PROXYTYPE); }
bool is_box(const btCollisionObjectWrapper& object) { return is(object, BOX_SHAPE_PROXYTYPE); }
bool is_sphere(const btCollisionObjectWrapper& object) { return is(object, SPHERE_SHAPE_PROXYTYPE); }
bool is_mesh(const btCollisionObjectWrapper& object) { return is(object, CONVEX_HULL_SHAPE_PROXYTYPE); }

const geometry::Solid& solid_of(const btCollisionObjectWrapper& object) {
  return *static_cast<const geometry::Solid*>(object.getCollisionShape()->getUserPointer());
}

/// Contacts of a sphere, a cylinder or a mesh above the half-space `n · x < height`.
std::vector<geometry::BoxContact> contacts_of_points(const btCollisionObjectWrapper& body, const Vector3d& n_W,
                                                     double height, double reach) {
  const RigidTransform X_WS = from_bullet(body.getWorldTransform());
  std::vector<geometry::BoxContact> found;
  for (const Vector3d& p_S : geometry::lowest_points(solid_of(body), X_WS.linear().transpose() * n_W)) {
    const Vector3d p_W = X_WS * p_S;
    const double gap = n_W.dot(p_W) - height;
    if (gap < reach) found.push_back({p_W - gap * n_W, n_W, gap});
  }
  return geometry::spanning(found, contact_skin);
}

using Contacts = std::vector<geometry::BoxContact>;

geometry::BoxContact swapped(const geometry::BoxContact& c) { return {c.p_W + c.gap * c.n_W, -c.n_W, c.gap}; }

/// What has become of a contact, if it is deep, and none that was found pushes as far to that side: it goes on where it
/// is, so that what is deeper than contacts are found is still pushed out where it went in.
std::optional<geometry::BoxContact> continued(const btManifoldPoint& before, const Contacts& contacts,
                                              const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
  const auto placed = [](const btCollisionObjectWrapper& w, const btVector3& p) {
    return from_bullet(w.getCollisionObject()->getWorldTransform() * p);
  };
  const Vector3d on_a = placed(a, before.m_localPointA), on_b = placed(b, before.m_localPointB);
  const Vector3d n_W = from_bullet(before.m_normalWorldOnB);
  const double depth = n_W.dot(on_b - on_a);
  const auto replaces = [&](const geometry::BoxContact& c) {
    return c.n_W.dot(n_W) > 0.0 && c.gap < deepest_on_path - depth;
  };
  if (!(depth > deepest_on_path) || std::any_of(contacts.begin(), contacts.end(), replaces)) return {};
  const auto out_of = [&](const btCollisionObjectWrapper& object, const Vector3d& p_W, const Vector3d& out_W) {
    const RigidTransform X_WS = from_bullet(object.getWorldTransform());
    auto c = geometry::exit_contact(solid_of(object), X_WS.inverse() * p_W, X_WS.linear().transpose() * out_W, depth,
                                    unswept_of_free);
    if (c) *c = {X_WS * c->p_W, X_WS.linear() * c->n_W, c->gap};
    return c;
  };
  const auto of_b = out_of(b, on_a, n_W);
  const auto of_a = out_of(a, on_b, -n_W);
  if (!of_a || (of_b && std::abs(of_b->gap + depth) <= std::abs(of_a->gap + depth))) return of_b;
  return swapped(*of_a);
}

/// The contacts of two solids, with those before that persist. None that touches, though they overlap: as at the
/// start of a scene; then the shallowest normal of all, however deep. `missing`: there is not even that.
std::vector<Contacts> contacts_between(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                                       double reach, const std::vector<btManifoldPoint>& before, bool& missing) {
  const RigidTransform X_WA = from_bullet(a.getWorldTransform()), X_WB = from_bullet(b.getWorldTransform());
  const auto found = [&](double margin, double deepest) {
    return geometry::solid_contacts(solid_of(a), X_WA, solid_of(b), X_WB, margin, deepest);
  };
  Contacts contacts = found(reach, unswept_of_free);
  if (is_sphere(a) || is_sphere(b)) return {contacts};
  Contacts deep;
  for (const btManifoldPoint& point : before) {
    if (const auto c = continued(point, contacts, a, b)) deep.push_back(*c);
  }
  contacts.insert(contacts.end(), deep.begin(), deep.end());
  const bool touch = std::any_of(contacts.begin(), contacts.end(), [](const auto& c) { return c.gap < closed_gap; });
  if (touch || !geometry::overlap(solid_of(a), X_WA, solid_of(b), X_WB))
    return geometry::by_normal(contacts, one_normal, contact_skin);
  std::vector<Contacts> groups =
      geometry::by_normal(found(0.0, std::numeric_limits<double>::infinity()), one_normal, contact_skin);
  missing = groups.empty();
  if (groups.size() > 1) groups.erase(groups.begin(), groups.end() - 1);
  return groups;
}

std::vector<geometry::BoxContact> contacts_above(const btCollisionObjectWrapper& body,
                                                 const btCollisionObjectWrapper& plane, double reach) {
  const auto& shape = static_cast<const btStaticPlaneShape&>(*plane.getCollisionShape());
  const RigidTransform X_WP = from_bullet(plane.getWorldTransform());
  const Vector3d n_W = X_WP.linear() * from_bullet(shape.getPlaneNormal());
  const double height = n_W.dot(X_WP.translation()) + shape.getPlaneConstant() - contact_skin;
  if (is_box(body)) {
    return geometry::box_contacts(outline_of(body), n_W, height, reach);
  }
  return contacts_of_points(body, n_W, height, reach);
}

geometry::SteadyMotion motion_of(const btCollisionObjectWrapper& object) {
  geometry::SteadyMotion motion;
  const btCollisionObject& body = *object.getCollisionObject();
  if (is_plane(object)) return motion;
  btVector3 centre;
  body.getCollisionShape()->getBoundingSphere(centre, motion.radius);
  motion.radius += centre.length();
  motion.p_W = from_bullet(body.getWorldTransform().getOrigin());
  const btRigidBody* rigid = btRigidBody::upcast(&body);
  if (rigid == nullptr || rigid->isStaticObject()) return motion;
  motion.v_W = from_bullet(rigid->getLinearVelocity());
  motion.w_W = from_bullet(rigid->getAngularVelocity());
  return motion;
}

/// Contacts of shapes with each other and with a plane, in either order, found again in every step; each begins with
/// the impulses of the one before that is nearest to it.
class SolidContacts final : public btActivatingCollisionAlgorithm {
 public:
  SolidContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
                const btCollisionObjectWrapper* b)
      : btActivatingCollisionAlgorithm(info, a, b) {
    const bool one_face = is_plane(*a) || is_plane(*b) || (is_box(*a) && is_box(*b)) ||
                          (is_sphere(*a) && !is_mesh(*b)) || (is_sphere(*b) && !is_mesh(*a));
    for (std::size_t i = 0; i < (one_face ? 1 : max_manifolds); ++i) {
      manifolds_.push_back(m_dispatcher->getNewManifold(a->getCollisionObject(), b->getCollisionObject()));
      manifolds_.back()->m_companionIdA = a->m_index;
      manifolds_.back()->m_companionIdB = b->m_index;
    }
  }
  ~SolidContacts() override {
    for (btPersistentManifold* manifold : manifolds_) m_dispatcher->releaseManifold(manifold);
  }

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                        const btDispatcherInfo& info, btManifoldResult* result) override {
    std::vector<btManifoldPoint> before;
    for (btPersistentManifold* manifold : manifolds_) {
      for (int i = 0; i < manifold->getNumContacts(); ++i) before.push_back(manifold->getContactPoint(i));
      manifold->clearManifold();
    }
    result->setPersistentManifold(manifolds_.front());
    const geometry::SteadyMotion moving_a = motion_of(*a), moving_b = motion_of(*b);
    const double h = info.m_timeStep,
                 reach = std::max(contact_margin, h * geometry::approach_speed(moving_a, moving_b));
    Contacts contacts = find(*a, *b, reach, before);
    if (!is_plane(*a) && !is_plane(*b)) {
      geometry::let_pass(solid_of(*a), from_bullet(a->getWorldTransform()), moving_a, solid_of(*b),
                         from_bullet(b->getWorldTransform()), moving_b, h, closed_gap, contacts);
    }
    // Not by the result's own addContactPoint(), which takes near ones for one.
    for (const geometry::BoxContact& c : contacts) {
      const auto free = std::find_if(manifolds_.begin(), manifolds_.end(), [](const btPersistentManifold* manifold) {
        return manifold->getNumContacts() < MANIFOLD_CACHE_SIZE;
      });
      if (free == manifolds_.end()) {
        miss(c.gap < closed_gap);
        continue;
      }
      btManifoldPoint point = made(c, *a->getCollisionObject(), *b->getCollisionObject());
      point.m_index0 = a->m_index;
      point.m_index1 = b->m_index;
      take_impulses(before, point);
      (*free)->addManifoldPoint(point);
    }
  }
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1.0;  // of Bullet's continuous mode, which is not used
  }
  void getAllContactManifolds(btManifoldArray& all) override {
    for (btPersistentManifold* manifold : manifolds_) all.push_back(manifold);
  }

 private:
  Contacts find(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, double reach,
                const std::vector<btManifoldPoint>& before) const {
    if (is_plane(b)) return contacts_above(a, b, reach);
    if (is_box(a) && is_box(b)) return geometry::box_contacts(outline_of(a), outline_of(b), reach);
    Contacts contacts;
    if (is_plane(a)) {
      contacts = contacts_above(b, a, reach);
      for (geometry::BoxContact& c : contacts) c = swapped(c);
      return contacts;
    }
    bool missing = false;
    for (const Contacts& group : contacts_between(a, b, reach, before, missing)) {
      contacts.insert(contacts.end(), group.begin(), group.end());
    }
    std::stable_sort(contacts.begin(), contacts.end(), [](const auto& x, const auto& y) { return x.gap < y.gap; });
    miss(missing);
    return contacts;
  }
  void miss(bool contact) const {
    auto& dispatcher = static_cast<DispatcherForSleepers&>(*m_dispatcher);
    dispatcher.contacts_missing = dispatcher.contacts_missing || contact;
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
  std::vector<btPersistentManifold*> manifolds_;
};

}  // namespace

btCollisionAlgorithmCreateFunc* ContactConfiguration::getCollisionAlgorithmCreateFunc(int proxy_a, int proxy_b) {
  // Of which only two cylinders have no contacts of ours.
  if (proxy_a != proxy_b || proxy_a != CYLINDER_SHAPE_PROXYTYPE) {
    const auto is_known = [](int proxy) {
      return proxy == BOX_SHAPE_PROXYTYPE || proxy == SPHERE_SHAPE_PROXYTYPE || proxy == CYLINDER_SHAPE_PROXYTYPE ||
             proxy == CONVEX_HULL_SHAPE_PROXYTYPE || proxy == STATIC_PLANE_PROXYTYPE;
    };
    if (is_known(proxy_a) && is_known(proxy_b)) return &create_;
  }
  return btDefaultCollisionConfiguration::getCollisionAlgorithmCreateFunc(proxy_a, proxy_b);
}

btCollisionAlgorithm* ContactConfiguration::Create::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                             const btCollisionObjectWrapper* a,
                                                                             const btCollisionObjectWrapper* b) {
  return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(SolidContacts))) SolidContacts(info, a, b);
}

}  // namespace spring_workbench::rigid_bodies
