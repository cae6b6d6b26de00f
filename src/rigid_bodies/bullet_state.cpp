// The state of Bullet's world between two steps, its own caches included: in which order it looks at things, and from
// which impulses it starts, decides on the last bits of a step.
#include <algorithm>
#include <functional>
#include <new>
#include <stdexcept>
#include <utility>

#include "bullet_world.h"

// Beside Bullet's types, where the archive looks for them.
static void archive_state(spring_workbench::math::StateArchive& state, btVector3& v) { state(v[0], v[1], v[2]); }

static void archive_state(spring_workbench::math::StateArchive& state, btTransform& X) {
  state(X.getBasis()[0], X.getBasis()[1], X.getBasis()[2], X.getOrigin());
}

static void archive_state(spring_workbench::math::StateArchive& state, btManifoldPoint& p) {
  state(p.m_localPointA, p.m_localPointB, p.m_positionWorldOnB, p.m_positionWorldOnA, p.m_normalWorldOnB,
        p.m_lateralFrictionDir1, p.m_lateralFrictionDir2, p.m_distance1, p.m_combinedFriction,
        p.m_combinedRollingFriction, p.m_combinedSpinningFriction, p.m_combinedRestitution, p.m_partId0, p.m_partId1,
        p.m_index0, p.m_index1, p.m_contactPointFlags, p.m_appliedImpulse, p.m_prevRHS, p.m_appliedImpulseLateral1,
        p.m_appliedImpulseLateral2, p.m_contactMotion1, p.m_contactMotion2, p.m_contactCFM, p.m_contactERP,
        p.m_frictionCFM, p.m_lifeTime);
}

namespace spring_workbench::rigid_bodies {
namespace {

btDbvtProxy& proxy_of(btCollisionObject& object) { return *static_cast<btDbvtProxy*>(object.getBroadphaseHandle()); }

int index_of(const btBroadphaseProxy& proxy) {
  return static_cast<const btCollisionObject*>(proxy.m_clientObject)->getUserIndex();
}

/// Identifies a manifold among those of its two bodies: the parts of their shapes between which it is.
std::array<int, 4> key_of(const btPersistentManifold& manifold) {
  std::array<int, 4> key{manifold.getBody0()->getUserIndex(), manifold.getBody1()->getUserIndex(),
                         manifold.m_companionIdA, manifold.m_companionIdB};
  if (manifold.getNumContacts() > 0) {
    key[2] = manifold.getContactPoint(0).m_index0;
    key[3] = manifold.getContactPoint(0).m_index1;
  }
  return key;
}

/// Two bodies whose boxes overlap, by user index.
struct Pair {
  int a = 0, b = 0;
  bool has_algorithm = false;
  int parts = 0;
  void archive(math::StateArchive& state) { state(a, b, has_algorithm, parts); }
};

/// How many pairs of parts of the two bodies' shapes are near each other, or may have contacts.
int parts_of(const btBroadphasePair& pair) {
  btManifoldArray manifolds;
  if (pair.m_algorithm != nullptr) pair.m_algorithm->getAllContactManifolds(manifolds);
  return manifolds.size();
}

/// Centre of the box around it, in world.
btVector3 centre_of(const btCollisionObject& object) {
  btVector3 min, max;
  object.getCollisionShape()->getAabb(object.getWorldTransform(), min, max);
  return 0.5 * (min + max);
}

}  // namespace

void DispatcherForSleepers::set_order(const std::vector<btPersistentManifold*>& manifolds) {
  for (std::size_t i = 0; i < manifolds.size(); ++i) {
    m_manifoldsPtr[static_cast<int>(i)] = manifolds[i];
    manifolds[i]->m_index1a = static_cast<int>(i);
  }
}

btRigidBody& BulletWorld::object(int index) {
  return index < 0 ? *bench_body_ : *items_.at(static_cast<std::size_t>(index)).bullet;
}

void BulletWorld::archive(math::StateArchive& state) {
  std::vector<int> objects;  // in Bullet's order
  for (int i = 0; i < world_.getNumCollisionObjects(); ++i) {
    objects.push_back(world_.getCollisionObjectArray()[i]->getUserIndex());
  }
  if (state.is_restoring()) {
    for (const int index : objects) world_.removeRigidBody(&object(index));
  }
  for (Item& item : items_) {
    state(item.X_WO, item.V_WO_W, item.near_at, item.in_world);
    if (state.is_restoring()) update_box(item);
  }
  state(steps_, in_world_, objects, surfaces_);
  if (state.is_restoring()) {
    for (const int index : objects) {
      if (index >= 0 && !items_.at(static_cast<std::size_t>(index)).bullet)
        make_bullet(static_cast<std::size_t>(index));
      world_.addRigidBody(&object(index));
    }
  }
  for (const int index : objects) archive_body(state, index);
  archive_pairs(state, objects);
  archive_manifolds(state);
  archive_broadphase(state, objects);
}

void BulletWorld::archive_body(math::StateArchive& state, int index) {
  btRigidBody& body = object(index);
  btVector3 v = body.getLinearVelocity(), w = body.getAngularVelocity();
  btVector3 v_next = body.getInterpolationLinearVelocity(), w_next = body.getInterpolationAngularVelocity();
  int activation = body.getActivationState();
  double slow_for = body.getDeactivationTime();
  state(body.getWorldTransform(), body.getInterpolationWorldTransform(), v, w, v_next, w_next, activation, slow_for);
  if (index >= 0) state(items_[static_cast<std::size_t>(index)].X_at_query);
  if (!state.is_restoring()) return;
  body.clearForces();
  body.setLinearVelocity(v);
  body.setAngularVelocity(w);
  body.setInterpolationLinearVelocity(v_next);
  body.setInterpolationAngularVelocity(w_next);
  body.updateInertiaTensor();
  body.forceActivationState(activation);
  body.setDeactivationTime(slow_for);
}

void BulletWorld::archive_pairs(math::StateArchive& state, const std::vector<int>& objects) {
  btOverlappingPairCache& cache = *broadphase_.getOverlappingPairCache();
  std::vector<Pair> pairs;
  const btBroadphasePairArray& present = cache.getOverlappingPairArray();
  for (int i = 0; i < present.size(); ++i) {
    const btBroadphasePair& pair = present[i];
    pairs.push_back(
        {index_of(*pair.m_pProxy0), index_of(*pair.m_pProxy1), pair.m_algorithm != nullptr, parts_of(pair)});
  }
  while (state.is_restoring() && present.size() > 0) {
    cache.removeOverlappingPair(present[0].m_pProxy0, present[0].m_pProxy1, &dispatcher_);
  }
  for (const int index : objects) {
    btDbvtProxy& proxy = proxy_of(object(index));
    state(proxy.m_uniqueId, proxy.stage, proxy.m_aabbMin, proxy.m_aabbMax);
  }
  state(pairs);
  if (!state.is_restoring()) return;
  // The contacts between parts of shapes are found again, at the poses of the last query.
  std::vector<btTransform> X_now;
  for (const int index : objects) {
    X_now.push_back(object(index).getWorldTransform());
    if (index >= 0) object(index).setWorldTransform(items_[static_cast<std::size_t>(index)].X_at_query);
  }
  for (const Pair& pair : pairs) {
    btBroadphasePair* added = cache.addOverlappingPair(&proxy_of(object(pair.a)), &proxy_of(object(pair.b)));
    if (added == nullptr) throw std::out_of_range("contact pair of bodies that cannot collide");
    if (pair.has_algorithm) find_contacts_of(*added, pair.parts);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) object(objects[i]).setWorldTransform(X_now[i]);
}

void BulletWorld::find_contacts_of(btBroadphasePair& pair, int parts) {
  const auto look = [&] { dispatcher_.getNearCallback()(pair, dispatcher_, world_.getDispatchInfo()); };
  look();
  if (parts_of(pair) >= parts) return;
  // Parts that have come near are kept a little longer than it takes to come near: bring the bodies together before.
  btCollisionObject& a = *static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject);
  btCollisionObject& b = *static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject);
  const btTransform X_at_query = b.getWorldTransform();
  b.getWorldTransform().setOrigin(X_at_query.getOrigin() + centre_of(a) - centre_of(b));
  look();
  b.setWorldTransform(X_at_query);
  look();
}

void BulletWorld::archive_manifolds(math::StateArchive& state) {
  std::vector<btPersistentManifold*> left, ordered;
  for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) left.push_back(dispatcher_.getManifoldByIndexInternal(m));
  std::size_t count = left.size();
  state(count);
  for (std::size_t m = 0; m < count; ++m) {
    std::array<int, 4> key = state.is_restoring() ? std::array<int, 4>{} : key_of(*left[m]);
    state(key);
    btPersistentManifold* manifold = state.is_restoring() ? nullptr : left[m];
    if (state.is_restoring()) {
      const auto is = [&](const btPersistentManifold* other) { return key_of(*other) == key; };
      const auto of_bodies = [&](const btPersistentManifold* other) {
        return key_of(*other)[0] == key[0] && key_of(*other)[1] == key[1];
      };
      auto found = std::find_if(left.begin(), left.end(), is);
      if (found == left.end()) found = std::find_if(left.begin(), left.end(), of_bodies);
      if (found == left.end()) throw std::out_of_range("contact between bodies that are not near each other");
      manifold = *found;
      ordered.push_back(manifold);
      left.erase(found);
    }
    int points = manifold->getNumContacts();
    state(points);
    if (points < 0 || points > MANIFOLD_CACHE_SIZE) throw std::out_of_range("invalid number of contact points");
    manifold->setNumContacts(points);
    for (int k = 0; k < points; ++k) state(manifold->getContactPoint(k));
  }
  if (!state.is_restoring()) return;
  ordered.insert(ordered.end(), left.begin(), left.end());
  dispatcher_.set_order(ordered);
}

void BulletWorld::archive_broadphase(math::StateArchive& state, const std::vector<int>& objects) {
  for (btDbvtProxy*& root : broadphase_.m_stageRoots) {
    std::vector<int> stage;
    for (const btDbvtProxy* proxy = root; !state.is_restoring() && proxy != nullptr; proxy = proxy->links[1]) {
      stage.push_back(index_of(*proxy));
    }
    state(stage);
    if (!state.is_restoring()) continue;
    btDbvtProxy* last = root = nullptr;
    for (const int index : stage) {
      btDbvtProxy* proxy = &proxy_of(object(index));
      proxy->links[0] = last;
      proxy->links[1] = nullptr;
      (last != nullptr ? last->links[1] : root) = proxy;
      last = proxy;
    }
  }
  for (btDbvt& tree : broadphase_.m_sets) archive_tree(state, tree, objects);
  btDbvtBroadphase& b = broadphase_;
  state(b.m_stageCurrent, b.m_newpairs, b.m_fixedleft, b.m_updates_call, b.m_updates_done, b.m_updates_ratio, b.m_pid,
        b.m_cid, b.m_gid, b.m_needcleanup);
}

void BulletWorld::archive_tree(math::StateArchive& state, btDbvt& tree, const std::vector<int>& objects) {
  const bool sets = state.is_restoring();
  int leaves = tree.m_root == nullptr ? 0 : tree.m_leaves;
  state(leaves);
  if (sets) tree.clear();
  if (sets) tree.m_leaves = leaves;
  const std::function<void(btDbvtNode*&, btDbvtNode*)> archive_node = [&](btDbvtNode*& node, btDbvtNode* parent) {
    constexpr int internal = -2;
    int index = sets || node->isinternal() ? internal : index_of(*static_cast<btDbvtProxy*>(node->data));
    state(index);
    if (sets) {
      node = new (btAlignedAlloc(sizeof(btDbvtNode), 16)) btDbvtNode();
      node->parent = parent;
    }
    state(node->volume.tMins(), node->volume.tMaxs());
    if (index == internal) {
      for (btDbvtNode*& child : node->childs) archive_node(child, node);
    } else if (sets) {
      if (std::find(objects.begin(), objects.end(), index) == objects.end())
        throw std::out_of_range("the collision tree refers to an unknown body");
      node->childs[1] = nullptr;
      node->data = &proxy_of(object(index));
      proxy_of(object(index)).leaf = node;
    }
  };
  if (leaves > 0) archive_node(tree.m_root, nullptr);
}

}  // namespace spring_workbench::rigid_bodies
