#include "spring_workbench/world/rigid_world.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "bullet_shape.h"
#include "driven_solver.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/scene/geometry.h"

namespace spring_workbench {
namespace {

constexpr double margin_near = 2e-3;      ///< [m]; what comes nearer than this to an awake body enters Bullet's world
constexpr int steps_until_left = 50;      ///< a sleeper leaves Bullet's world when nothing awake was near for so many steps
constexpr double asleep_speed = 2e-3;     ///< [m/s] of every point of a body …
constexpr double asleep_after = 0.5;      ///< [s] … for so long: it goes to sleep
constexpr double rest_speed = 0.02;       ///< [m/s]; a slower approach does not bounce
constexpr double penetration_share = 0.2; ///< of a penetration that is undone in a step, where it pushes free bodies
constexpr double closed_gap = 1e-5;       ///< [m]; a contact without impulse is told while its gap is smaller

using Extent = Eigen::AlignedBox3d;

/// Extent in world of a box in O placed at `X_WO`.
Extent placed(const Extent& box_O, const RigidTransform& X_WO) {
  const Vector3d centre = X_WO * box_O.center();
  const Vector3d half = X_WO.linear().cwiseAbs() * (0.5 * box_O.sizes());
  return Extent(centre - half, centre + half);
}

btDbvtVolume volume(const Extent& box) { return btDbvtVolume::FromMM(to_bullet(box.min()), to_bullet(box.max())); }

}  // namespace

struct RigidWorld::Impl {
  struct Item {
    bool movable = false;
    Extent box_O;
    double radius = 0.0;
    RigidTransform X_WO = RigidTransform::Identity();
    Twist V_WO_W;
    RigidTransform X_OB = RigidTransform::Identity();  ///< principal axes, where Bullet's tensors are diagonal
    btDbvtNode* leaf = nullptr;
    std::unique_ptr<BulletShape> shape;      ///< these two are made when the body first comes near another
    std::unique_ptr<btRigidBody> bullet;
    bool in_world = false;
    bool driven = false;
    long near_at = 0;                        ///< step in which something awake was last near
  };
  struct Found : btDbvt::ICollide {
    std::vector<std::size_t> items;
    void Process(const btDbvtNode* leaf) override { items.push_back(static_cast<std::size_t>(leaf->dataAsInt)); }
  };

  Scene scene;
  std::vector<Item> items;
  btDbvt tree;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  DrivenSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btStaticPlaneShape bench_shape;
  std::unique_ptr<btRigidBody> bench_body;
  std::vector<std::size_t> in_world;
  std::vector<WorldContact> contacts;
  long steps = 0;

  explicit Impl(const Scene& s);
  ~Impl();
  void make_bullet(std::size_t index);
  void enter(std::size_t index);
  void leave(std::size_t index);
  void update_box(Item& item);
  void put(std::size_t index, const RigidTransform& X_WO, const Twist& V_WO_W);
  void gather_neighbours(std::size_t index, const Extent& way);
  void take_states();
  void take_contacts();
  Extent way_of(std::size_t index, double h) const;
  bool awake(const Item& item) const {
    return item.in_world && item.movable && (item.driven || item.bullet->isActive());
  }
};

RigidWorld::Impl::Impl(const Scene& s) : scene(s), bench_shape(btVector3(0, 0, 1), s.bench_height + contact_skin) {
  gContactBreakingThreshold = 4.0 * contact_skin;
  gDeactivationTime = asleep_after;
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
  configuration.setPlaneConvexMultipointIterations(4, 4);  // a flush face touches with its corners from the first step on
  configuration.setConvexConvexMultipointIterations(4, 4);
  world.setGravity(btVector3(0.0, 0.0, -scene.gravity));
  btContactSolverInfo& info = world.getSolverInfo();
  info.m_splitImpulse = true;  // what is undone of a penetration becomes no speed
  info.m_splitImpulsePenetrationThreshold = 0.0;
  info.m_erp2 = penetration_share;
  info.m_linearSlop = 2.0 * contact_skin;
  info.m_restitutionVelocityThreshold = rest_speed;
  info.m_solverMode = SOLVER_USE_2_FRICTION_DIRECTIONS | SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
  world.setForceUpdateAllAabbs(false);

  bench_body = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0.0, nullptr, &bench_shape));
  bench_body->setFriction(std::sqrt(scene.bench_material.friction));
  bench_body->setRestitution(std::sqrt(scene.bench_material.restitution));
  bench_body->setUserIndex(-1);
  world.addRigidBody(bench_body.get());

  items.resize(scene.bodies.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    Item& item = items[i];
    const Body& body = scene.bodies[i];
    item.movable = body.movable && body.mass_properties.mass > 0.0;
    item.box_O = bounding_box(body);
    item.X_WO = body.X_WO;
    if (item.box_O.isEmpty()) continue;  // nothing to touch
    item.radius = bounding_radius(body);
    item.leaf = tree.insert(volume(placed(item.box_O, item.X_WO)), nullptr);
    item.leaf->dataAsInt = static_cast<int>(i);
  }
}

RigidWorld::Impl::~Impl() {
  for (const std::size_t i : in_world) world.removeRigidBody(items[i].bullet.get());
  world.removeRigidBody(bench_body.get());
}

void RigidWorld::Impl::make_bullet(std::size_t index) {
  Item& item = items[index];
  const Body& body = scene.bodies[index];
  btVector3 principal(0, 0, 0);
  if (item.movable) {
    const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(body.mass_properties.inertia_O);
    Matrix3d R = axes.eigenvectors();
    if (R.determinant() < 0.0) R.col(0) = -R.col(0);
    item.X_OB.linear() = R;
    principal = to_bullet(Vector3d(axes.eigenvalues()));
  }
  item.shape = std::make_unique<BulletShape>(body, item.X_OB);
  btRigidBody::btRigidBodyConstructionInfo info(item.movable ? body.mass_properties.mass : 0.0, nullptr,
                                                item.shape->get(), principal);
  info.m_linearSleepingThreshold = asleep_speed;
  info.m_angularSleepingThreshold = asleep_speed / std::max(item.radius, 1e-9);
  item.bullet = std::make_unique<btRigidBody>(info);
  item.bullet->setFriction(std::sqrt(body.material.friction));
  item.bullet->setRestitution(std::sqrt(body.material.restitution));
  item.bullet->setUserIndex(static_cast<int>(index));
}

void RigidWorld::Impl::update_box(Item& item) {
  if (item.leaf == nullptr) return;
  btDbvtVolume box = volume(placed(item.box_O, item.X_WO));
  tree.update(item.leaf, box);
}

void RigidWorld::Impl::put(std::size_t index, const RigidTransform& X_WO, const Twist& V_WO_W) {
  Item& item = items[index];
  item.X_WO = X_WO;
  item.V_WO_W = V_WO_W;
  update_box(item);
  if (!item.bullet) return;
  const btTransform X_WB = to_bullet(RigidTransform(X_WO * item.X_OB));
  item.bullet->setWorldTransform(X_WB);
  item.bullet->setInterpolationWorldTransform(X_WB);
  if (!item.movable) return;
  item.bullet->setLinearVelocity(to_bullet(V_WO_W.linear));
  item.bullet->setAngularVelocity(to_bullet(V_WO_W.angular));
  item.bullet->setInterpolationLinearVelocity(to_bullet(V_WO_W.linear));
  item.bullet->setInterpolationAngularVelocity(to_bullet(V_WO_W.angular));
  item.bullet->updateInertiaTensor();
  if (item.in_world) world.updateSingleAabb(item.bullet.get());
}

void RigidWorld::Impl::enter(std::size_t index) {
  Item& item = items[index];
  item.near_at = steps;
  if (item.in_world || item.leaf == nullptr) return;
  if (!item.bullet) make_bullet(index);
  put(index, item.X_WO, item.V_WO_W);
  item.bullet->clearForces();
  item.bullet->forceActivationState(item.movable ? ISLAND_SLEEPING : ACTIVE_TAG);
  item.bullet->setDeactivationTime(0.0);
  world.addRigidBody(item.bullet.get());
  item.in_world = true;
  in_world.push_back(index);
}

void RigidWorld::Impl::leave(std::size_t index) {
  Item& item = items[index];
  world.removeRigidBody(item.bullet.get());
  item.in_world = false;
  item.V_WO_W = Twist();
  in_world.erase(std::find(in_world.begin(), in_world.end(), index));
}

Extent RigidWorld::Impl::way_of(std::size_t index, double h) const {
  const Item& item = items[index];
  Extent box = placed(item.box_O, item.X_WO);
  const double turned = std::min(h * item.V_WO_W.angular.norm() * item.radius, 2.0 * item.radius);
  const Vector3d moved = h * item.V_WO_W.linear;
  box.extend(Extent(box.min() + moved, box.max() + moved));
  const Vector3d margin = Vector3d::Constant(turned + margin_near);
  return Extent(box.min() - margin, box.max() + margin);
}

void RigidWorld::Impl::gather_neighbours(std::size_t index, const Extent& way) {
  Found found;
  tree.collideTV(tree.m_root, volume(way), found);
  std::sort(found.items.begin(), found.items.end());
  for (const std::size_t other : found.items) {
    if (other != index) enter(other);
  }
}

void RigidWorld::Impl::take_states() {
  for (const std::size_t i : in_world) {
    Item& item = items[i];
    if (!awake(item) || item.driven) continue;
    item.X_WO = from_bullet(item.bullet->getWorldTransform()) * item.X_OB.inverse();
    item.V_WO_W.linear = from_bullet(item.bullet->getLinearVelocity());
    item.V_WO_W.angular = from_bullet(item.bullet->getAngularVelocity());
    update_box(item);
  }
}

void RigidWorld::Impl::take_contacts() {
  contacts.clear();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const int a = manifold.getBody0()->getUserIndex(), b = manifold.getBody1()->getUserIndex();
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      const double gap = point.getDistance() + 2.0 * contact_skin;
      if (!(point.m_appliedImpulse > 0.0) && gap > closed_gap) continue;
      WorldContact c;
      const bool first_is_body = a >= 0;
      c.body = static_cast<std::size_t>(first_is_body ? a : b);
      const int other = first_is_body ? b : a;
      c.other = other >= 0 ? static_cast<std::size_t>(other) : bench;
      const Vector3d n = from_bullet(point.m_normalWorldOnB);
      const Vector3d impulse = point.m_appliedImpulse * n +
                               point.m_appliedImpulseLateral1 * from_bullet(point.m_lateralFrictionDir1) +
                               point.m_appliedImpulseLateral2 * from_bullet(point.m_lateralFrictionDir2);
      c.n_W = first_is_body ? n : Vector3d(-n);
      c.impulse_W = first_is_body ? impulse : Vector3d(-impulse);
      c.p_W = 0.5 * from_bullet(point.getPositionWorldOnA() + point.getPositionWorldOnB());
      c.depth = std::max(0.0, -gap);
      contacts.push_back(c);
    }
  }
}

RigidWorld::RigidWorld(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
RigidWorld::~RigidWorld() = default;
RigidWorld::RigidWorld(RigidWorld&&) noexcept = default;
RigidWorld& RigidWorld::operator=(RigidWorld&&) noexcept = default;

void RigidWorld::step(double h, std::vector<DrivenBody>& driven) {
  Impl& w = *impl_;
  ++w.steps;
  std::vector<DrivenSolver::Driven> for_solver;
  for (DrivenBody& d : driven) {
    Impl::Item& item = w.items[d.body];
    if (item.leaf == nullptr) continue;
    w.enter(d.body);
    item.driven = true;
    w.put(d.body, d.X_WO, {d.displacement_W.linear / h, d.displacement_W.angular / h});
    item.bullet->setGravity(btVector3(0, 0, 0));
    item.bullet->forceActivationState(DISABLE_DEACTIVATION);
    for_solver.push_back({item.bullet.get(), &d});
  }
  w.solver.set_driven(std::move(for_solver), h);
  const std::vector<std::size_t> present = w.in_world;
  for (const std::size_t i : present) {
    if (w.awake(w.items[i])) w.gather_neighbours(i, w.way_of(i, h));
  }
  w.world.stepSimulation(h, 0);
  w.take_states();
  w.take_contacts();
  for (const DrivenBody& d : driven) {
    Impl::Item& item = w.items[d.body];
    if (!item.bullet) continue;
    item.driven = false;
    item.bullet->setGravity(w.world.getGravity());
    item.bullet->forceActivationState(ACTIVE_TAG);
    w.put(d.body, d.X_WO, Twist());
  }
  const std::vector<std::size_t> still_there = w.in_world;
  for (const std::size_t i : still_there) {
    if (!w.awake(w.items[i]) && w.steps - w.items[i].near_at > steps_until_left) w.leave(i);
  }
}

void RigidWorld::place(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W, bool awake) {
  Impl& w = *impl_;
  Impl::Item& item = w.items[body];
  if (!awake && item.in_world) w.leave(body);
  w.put(body, X_WO, V_WO_W);
  if (!awake) return;
  w.enter(body);
  if (!item.in_world) return;
  item.bullet->forceActivationState(ACTIVE_TAG);
  item.bullet->setDeactivationTime(0.0);
}

const RigidTransform& RigidWorld::pose(std::size_t body) const { return impl_->items[body].X_WO; }
const Twist& RigidWorld::velocity(std::size_t body) const { return impl_->items[body].V_WO_W; }
bool RigidWorld::awake(std::size_t body) const { return impl_->awake(impl_->items[body]); }
bool RigidWorld::any_awake() const {
  return std::any_of(impl_->in_world.begin(), impl_->in_world.end(),
                     [&](std::size_t i) { return impl_->awake(impl_->items[i]); });
}

bool RigidWorld::may_touch(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                           double margin) const {
  const Impl& w = *impl_;
  const Impl::Item& item = w.items[body];
  if (item.leaf == nullptr) return false;
  Extent way = placed(item.box_O, X0_WO);
  way.extend(placed(item.box_O, X1_WO));
  const double turned = log_so3(X0_WO.linear().transpose() * X1_WO.linear()).norm();
  const Vector3d grown = Vector3d::Constant(margin + item.radius * std::min(turned, 2.0));
  way = Extent(way.min() - grown, way.max() + grown);
  if (way.min().z() < w.scene.bench_height) return true;
  Impl::Found found;
  w.tree.collideTV(w.tree.m_root, volume(way), found);
  return std::any_of(found.items.begin(), found.items.end(), [&](std::size_t i) { return i != body; });
}

const std::vector<WorldContact>& RigidWorld::contacts() const { return impl_->contacts; }
std::size_t RigidWorld::bodies_near() const { return impl_->in_world.size(); }

}  // namespace spring_workbench
