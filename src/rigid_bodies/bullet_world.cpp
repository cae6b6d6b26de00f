#include "bullet_world.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "constants.h"
#include "spring_workbench/bodies/free_motion.h"
#include "spring_workbench/geometry/conservative_advancement.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::rigid_bodies {
namespace {

using Extent = Eigen::AlignedBox3d;

btDbvtVolume volume(const Extent& box) { return btDbvtVolume::FromMM(to_bullet(box.min()), to_bullet(box.max())); }

}  // namespace

BulletWorld::BulletWorld(const scene::Scene& scene)
    : scene_(scene), bench_shape_(btVector3(0, 0, 1), scene.bench_height + contact_skin) {
  static const double set_once = gDeactivationTime = asleep_after;  // worlds may be made in several threads
  static_cast<void>(set_once);
  configuration_.setConvexConvexMultipointIterations(4, 4);  // two cylinders touch all along at once
  world_.setGravity(btVector3(0.0, 0.0, -scene_.gravity));
  btContactSolverInfo& info = world_.getSolverInfo();
  info.m_splitImpulse = true;  // what is undone of a penetration becomes no speed
  info.m_splitImpulsePenetrationThreshold = 0.0;
  info.m_erp2 = penetration_share;
  info.m_linearSlop = 2.0 * contact_skin;
  info.m_restitutionVelocityThreshold = scene::rest_speed;
  info.m_solverMode = SOLVER_USE_2_FRICTION_DIRECTIONS | SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
  world_.setForceUpdateAllAabbs(false);
  bench_body_ = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0.0, nullptr, &bench_shape_));
  bench_body_->setFriction(std::sqrt(scene_.bench_material.friction));
  bench_body_->setRestitution(std::sqrt(scene_.bench_material.restitution));
  bench_body_->setUserIndex(-1);
  world_.addRigidBody(bench_body_.get());

  items_.resize(scene_.bodies.size());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    Item& item = items_[i];
    const scene::Body& body = scene_.bodies[i];
    item.movable = body.movable;
    item.massless = body.movable && !(body.mass_properties.mass > 0.0);
    item.box_O = geometry::bounding_box(body.collision);
    item.X_WO = body.X_WO;
    if (item.box_O.isEmpty()) continue;  // nothing to touch
    item.radius = geometry::bounding_radius(body.collision);
    item.outline_O = geometry::outline(body.collision);
    item.leaf = tree_.insert(volume(geometry::bounding_box(item.box_O, item.X_WO)), nullptr);
    item.leaf->dataAsInt = static_cast<int>(i);
  }
}

BulletWorld::~BulletWorld() {
  for (const std::size_t i : in_world_) world_.removeRigidBody(items_[i].bullet.get());
  world_.removeRigidBody(bench_body_.get());
}

void BulletWorld::make_bullet(std::size_t index) {
  Item& item = items_[index];
  const scene::Body& body = scene_.bodies[index];
  double mass = item.movable ? body.mass_properties.mass : 0.0;
  btVector3 principal(0, 0, 0);
  if (item.massless) {  // of no effect: it moves only as it is driven
    mass = 1.0;
    principal.setValue(1.0, 1.0, 1.0);
  } else if (item.movable) {
    const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(body.mass_properties.inertia_O);
    Matrix3d R = axes.eigenvectors();
    if (R.determinant() < 0.0) R.col(0) = -R.col(0);
    item.X_OB.linear() = R;
    principal = to_bullet(Vector3d(axes.eigenvalues()));
  }
  item.shape = std::make_unique<BulletShape>(body, item.X_OB);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, item.shape->get(), principal);
  info.m_linearSleepingThreshold = scene::asleep_speed;
  info.m_angularSleepingThreshold = scene::asleep_speed / item.radius;
  item.bullet = std::make_unique<btRigidBody>(info);
  item.bullet->setFriction(std::sqrt(body.material.friction));
  item.bullet->setRestitution(std::sqrt(body.material.restitution));
  item.bullet->setUserIndex(static_cast<int>(index));
  if (item.massless) {
    let_move(*item.bullet, false);
    item.bullet->setFlags(item.bullet->getFlags() | BT_DISABLE_WORLD_GRAVITY);
  }
}

void BulletWorld::update_box(Item& item) {
  if (item.leaf == nullptr) return;
  btDbvtVolume box = volume(geometry::bounding_box(item.box_O, item.X_WO));
  tree_.update(item.leaf, box);
}

void BulletWorld::put(std::size_t index, const RigidTransform& X_WO, const Twist& V_WO_W) {
  Item& item = items_[index];
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
  if (item.in_world) world_.updateSingleAabb(item.bullet.get());
}

void BulletWorld::enter(std::size_t index) {
  Item& item = items_[index];
  item.near_at = steps_;
  if (item.in_world || item.leaf == nullptr) return;
  if (!item.bullet) make_bullet(index);
  put(index, item.X_WO, item.V_WO_W);
  item.bullet->clearForces();
  item.bullet->forceActivationState(item.movable ? ISLAND_SLEEPING : ACTIVE_TAG);
  item.bullet->setDeactivationTime(0.0);
  world_.addRigidBody(item.bullet.get());
  item.in_world = true;
  in_world_.push_back(index);
  if (item.movable) before_step_.push_back({index, item.X_WO, item.V_WO_W, ISLAND_SLEEPING, 0.0});
}

void BulletWorld::leave(std::size_t index) {
  Item& item = items_[index];
  world_.removeRigidBody(item.bullet.get());
  item.in_world = false;
  item.V_WO_W = Twist();
  in_world_.erase(std::find(in_world_.begin(), in_world_.end(), index));
}

Extent BulletWorld::path_of(std::size_t index, double h) const {
  const Item& item = items_[index];
  Extent box = geometry::bounding_box(item.box_O, item.X_WO);
  const double arc = std::min(h * item.V_WO_W.angular.norm() * item.radius, 2.0 * item.radius);
  box.extend(Extent(box).translate(h * item.V_WO_W.linear));
  return geometry::grown(box, arc + margin_near + 0.5 * scene_.gravity * h * h);
}

std::vector<std::size_t> BulletWorld::inside(const Extent& box_W) const {
  struct Found : btDbvt::ICollide {
    std::vector<std::size_t> items;
    void Process(const btDbvtNode* leaf) override { items.push_back(static_cast<std::size_t>(leaf->dataAsInt)); }
  } found;
  tree_.collideTV(tree_.m_root, volume(box_W), found);
  std::sort(found.items.begin(), found.items.end());  // the tree's order depends on its history
  return found.items;
}

void BulletWorld::take_states(double h) {
  path_error_ = 0.0;
  std::vector<std::pair<std::size_t, motion::MotionState>> moved;
  for (const bodies::FreeMotion& m : solver_.free_motions()) {
    path_error_ = std::max(path_error_, bodies::path_error(m, items_[m.body].radius, h));
    if (m.mean) moved.emplace_back(m.body, bodies::moved(m, scene_.bodies[m.body], items_[m.body].X_WO, h));
  }
  for (const std::size_t i : in_world_) {
    Item& item = items_[i];
    if (!awake(item)) item.V_WO_W = Twist();
    if (item.driven || !awake(item)) continue;
    item.X_WO = from_bullet(item.bullet->getWorldTransform()) * item.X_OB.inverse();
    item.V_WO_W.linear = from_bullet(item.bullet->getLinearVelocity());
    item.V_WO_W.angular = from_bullet(item.bullet->getAngularVelocity());
    update_box(item);
  }
  for (const auto& [body, state] : moved)
    if (awake(items_[body])) put(body, state.X, state.velocity);
}

void BulletWorld::take_contacts(double h) {
  contacts_.clear();
  for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(m);
    const int a = manifold.getBody0()->getUserIndex(), b = manifold.getBody1()->getUserIndex();
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      const Vector3d impact_W = solver_.impact_on(point);
      const bool is_open = point.getDistance() + 2.0 * contact_skin > closed_gap;
      if (is_open && !(point.m_appliedImpulse > 0.0) && impact_W.isZero(0.0)) continue;
      WorldContact c = world_contact(point, a, b, h);
      c.impulse_W += (a >= 0 ? 1.0 : -1.0) * impact_W;
      contacts_.push_back(c);
    }
  }
}

void BulletWorld::begin_driving(std::vector<DrivenBody>& driven, double h) {
  std::vector<Driven> for_solver;
  for (DrivenBody& d : driven) {
    d.contact_W = d.impact_W = Wrench();
    Item& item = items_[d.body];
    if (item.leaf == nullptr) continue;
    enter(d.body);
    item.driven = true;
    put(d.body, d.X_WO, {d.displacement_W.linear / h, d.displacement_W.angular / h});
    item.bullet->setGravity(btVector3(0, 0, 0));
    item.bullet->forceActivationState(DISABLE_DEACTIVATION);
    if (item.massless) let_move(*item.bullet, true);
    for_solver.push_back({item.bullet.get(), &d});
  }
  solver_.set_driven(std::move(for_solver), h);
}

void BulletWorld::end_driving(const std::vector<DrivenBody>& driven) {
  for (const DrivenBody& d : driven) {
    Item& item = items_[d.body];
    if (!item.driven) continue;
    item.driven = false;
    item.massless ? let_move(*item.bullet, false) : item.bullet->setGravity(world_.getGravity());
    item.bullet->forceActivationState(ACTIVE_TAG);
    put(d.body, d.X_WO, Twist());
  }
}

void BulletWorld::enter_what_is_near(double h) {
  std::vector<std::size_t> reached;
  std::copy_if(in_world_.begin(), in_world_.end(), std::back_inserter(reached),
               [&](std::size_t i) { return awake(items_[i]); });
  std::set<std::size_t> known(reached.begin(), reached.end());
  for (std::size_t k = 0; k < reached.size(); ++k) {
    for (const std::size_t other : inside(path_of(reached[k], h))) {
      enter(other);
      if (items_[other].movable && known.insert(other).second) reached.push_back(other);
    }
  }
}

void BulletWorld::step(double h, std::vector<DrivenBody>& driven) {
  begin_step();
  begin_driving(driven, h);
  enter_what_is_near(h);
  for (const std::size_t i : in_world_) items_[i].X_at_query = items_[i].bullet->getWorldTransform();
  world_.stepSimulation(h, 0);
  take_states(h);
  take_contacts(h);
  end_driving(driven);
  const std::vector<std::size_t> still_there = in_world_;
  for (const std::size_t i : still_there) {
    if (!awake(items_[i]) && steps_ - items_[i].near_at > steps_until_left) leave(i);
  }
}

void BulletWorld::begin_step() {
  ++steps_;
  dispatcher_.contacts_missing = false;
  before_step_.clear();
  for (const std::size_t i : in_world_) {
    const Item& item = items_[i];
    if (!item.movable) continue;
    before_step_.push_back(
        {i, item.X_WO, item.V_WO_W, item.bullet->getActivationState(), item.bullet->getDeactivationTime()});
  }
}

void BulletWorld::undo_step() {
  surfaces_.undo_step();
  for (const BeforeStep& r : before_step_) {
    put(r.body, r.X_WO, r.V_WO_W);
    items_[r.body].bullet->forceActivationState(r.activation);
    items_[r.body].bullet->setDeactivationTime(r.slow_for);
  }
}

void BulletWorld::place(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W, bool awake) {
  Item& item = items_[body];
  if (!awake && item.in_world) leave(body);
  put(body, X_WO, V_WO_W);
  if (!awake) return;
  enter(body);
  if (!item.in_world) return;
  item.bullet->forceActivationState(ACTIVE_TAG);
  item.bullet->setDeactivationTime(0.0);
}

Extent BulletWorld::swept(const Item& item, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                          double margin) const {
  Extent path = geometry::bounding_box(item.box_O, X0_WO);
  path.extend(geometry::bounding_box(item.box_O, X1_WO));
  const double angle = math::turn_between(X0_WO, X1_WO).norm();
  return geometry::grown(path, margin + item.radius * std::min(angle, 2.0));
}

RigidWorld::Bodies BulletWorld::movable_near(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                                             double h, const Bodies& carried, std::size_t max_count) const {
  if (items_[body].leaf == nullptr) return {};
  std::set<std::size_t> near;
  const Extent path = swept(items_[body], X0_WO, X1_WO, margin_near);
  const auto add = [&](const Bodies& of, const auto& is) {
    std::copy_if(of.begin(), of.end(), std::inserter(near, near.end()), [&](auto i) { return i != body && is(i); });
  };
  const auto comes = [&](auto i) {
    return near.size() < max_count && items_[i].leaf && path_of(i, h).intersects(path);
  };
  add(inside(path), [&](auto i) { return items_[i].movable; });
  add(in_world_, [&](auto i) { return awake(items_[i]) && comes(i); });
  add(carried, comes);
  return {near.begin(), near.end()};
}

bool BulletWorld::may_touch(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                            double margin) const {
  if (items_[body].leaf == nullptr) return false;
  const Extent path = swept(items_[body], X0_WO, X1_WO, margin);
  const std::vector<std::size_t> found = inside(path);
  return path.min().z() < scene_.bench_height || found.size() > 1 || (found.size() == 1 && found[0] != body);
}

RigidTransform BulletWorld::pose_before_step(std::size_t body) const {
  const auto found =
      std::find_if(before_step_.begin(), before_step_.end(), [&](const auto& r) { return r.body == body; });
  return found == before_step_.end() ? items_[body].X_WO : found->X_WO;
}

double BulletWorld::free_fraction(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                                  bool untouched, double may_go_unswept) const {
  const Item& item = items_[body];
  if (item.leaf == nullptr) return 1.0;
  double part = 1.0;
  const Matrix3d R_OW = X0_WO.linear().transpose();
  const Vector3d extent_O = item.box_O.min().cwiseAbs().cwiseMax(item.box_O.max().cwiseAbs());
  // Of a pair whose shapes are not both boxes, what the boxes around them say.
  const auto by_extent = [&](const geometry::BoxGap& gap, const auto& path, const Vector3d& most_O) {
    const double left = gap.gap - 2.0 * contact_skin;
    const bool near = left < may_go_unswept;
    const double approach =
        near ? path.max_displacement(R_OW, most_O) : path.max_displacement_along(-gap.n_W, R_OW, most_O);
    const double allowed = std::max(left, untouched ? 0.0 : may_go_unswept);
    if (allowed < part * approach) part = allowed / approach;
  };
  const auto admissible = [&](std::size_t other) { return deepest_on_path + surfaces_.indentation(body, other); };
  const auto tolerance = [&](const geometry::BoxGap& gap, std::size_t other) {
    return untouched ? 0.0 : std::max(admissible(other), same_depth - gap.gap);
  };
  const geometry::StraightMotion path = geometry::straight_motion(X0_WO, X1_WO);
  for (const geometry::OutlineBox& own : item.outline_O) {
    const geometry::OutlineBox here{X0_WO * own.X, own.half, own.exact};
    const geometry::BoxGap above = geometry::gap_above(here, scene_.bench_height);
    if (own.exact) {
      part = geometry::free_fraction_above(here, path, {Vector3d::UnitZ(), scene_.bench_height},
                                           tolerance(above, bench), part);
    } else {
      by_extent(above, path, extent_O);
    }
  }
  for (const std::size_t i : inside(swept(item, X0_WO, X1_WO, 2.0 * contact_skin))) {
    const Item& other = items_[i];
    // The end of a driven one may not be known yet: the pair is judged with that.
    if (i == body || (!untouched && solver_.drove(other.bullet.get()) && !solver_.drove(item.bullet.get()))) continue;
    const RigidTransform X_before = untouched ? other.X_WO : pose_before_step(i);
    const RigidTransform X1_seen = X_before * other.X_WO.inverse() * X1_WO;
    const geometry::StraightMotion relative = geometry::straight_motion(X0_WO, X1_seen);
    const Vector3d most_O = extent_O.cwiseMin(relative.reach(X_before.translation(), other.radius));
    for (const geometry::OutlineBox& own : item.outline_O) {
      const geometry::OutlineBox here{X0_WO * own.X, own.half, own.exact};
      for (const geometry::OutlineBox& box : other.outline_O) {
        const geometry::OutlineBox there{X_before * box.X, box.half, box.exact};
        const geometry::BoxGap gap = geometry::gap_between(here, there);
        if (own.exact && box.exact) {
          part = geometry::free_fraction_past(here, relative, there, tolerance(gap, i), part);
        } else {
          by_extent(gap, relative, most_O);
        }
      }
    }
    if (untouched || part < 1.0 || !item.shape || !other.shape) continue;
    const double allowed = std::max(admissible(i), depth_between(body, i, contacts_)) + same_depth;
    const double moved = relative.max_displacement(R_OW, most_O);
    part = BulletShape::fraction_before(*item.shape, X0_WO * item.X_OB, X1_seen * item.X_OB, moved, *other.shape,
                                        X_before * other.X_OB, allowed);
  }
  return part;
}

double BulletWorld::admissible_fraction_of_free() const {
  double part = 1.0;
  for (const BeforeStep& before : before_step_) {
    const Item& item = items_[before.body];
    const double arc = item.radius * math::turn_between(before.X_WO, item.X_WO).norm();
    const double path = (item.X_WO.translation() - before.X_WO.translation()).norm() + arc;
    if (path < deepest_on_path) continue;
    part = std::min(part,
                    free_fraction(before.body, before.X_WO, item.X_WO, false,
                                  path < unswept_of_free ? std::numeric_limits<double>::infinity() : unswept_of_free));
  }
  return part;
}

std::unique_ptr<RigidWorld> make_rigid_world(const scene::Scene& scene) { return std::make_unique<BulletWorld>(scene); }

}  // namespace spring_workbench::rigid_bodies
