#include "spring_workbench/collision/collision_world.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench_contacts.h"
#include "constants.h"
#include "manifold_reduction.h"
#include "narrow_phase.h"
#include "spring_workbench/geometry/box_gap.h"
#include "spring_workbench/geometry/conservative_advancement.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::collision {
namespace {

/// An axis-aligned box as an object of FCL's broadphase.
class BoxObject {
 public:
  explicit BoxObject(std::size_t part)
      : box_(std::make_shared<fcl::Boxd>(1.0, 1.0, 1.0)), object_(std::make_unique<fcl::CollisionObjectd>(box_)) {
    object_->setUserData(reinterpret_cast<void*>(part));  // NOLINT(performance-no-int-to-ptr): FCL keeps a pointer
  }

  void place(const Eigen::AlignedBox3d& around) {
    box_->side = around.sizes();
    box_->computeLocalAABB();
    object_->setTranslation(around.center());
    object_->computeAABB();
  }
  fcl::CollisionObjectd* get() const { return object_.get(); }
  static std::size_t part_of(const fcl::CollisionObjectd* object) {
    return reinterpret_cast<std::size_t>(object->getUserData());
  }

 private:
  std::shared_ptr<fcl::Boxd> box_;
  std::unique_ptr<fcl::CollisionObjectd> object_;
};

/// One shape of a body.
struct Part {
  std::size_t body;
  geometry::Geometry geometry;
  RigidTransform X_OS;
  RigidTransform X_WS;
  std::size_t solid;  // in the narrow phase
  BoxObject in_broadphase;
  Eigen::AlignedBox3d extent;  // in the shape's frame

  /// A box around the part placed at `X`; for a mesh around its own box, so that its size does not matter.
  Eigen::AlignedBox3d box_at(const RigidTransform& X) const {
    if (!std::holds_alternative<geometry::MeshPtr>(geometry)) return geometry::bounding_box(geometry, X);
    return geometry::bounding_box(extent, X);
  }
  /// A box around it in its own axes.
  geometry::OutlineBox outline(const RigidTransform& X) const {
    return {X * Eigen::Translation3d(extent.center()), 0.5 * extent.sizes(),
            std::holds_alternative<geometry::Box>(geometry)};
  }
};

/// A body's parts, how far they reach from its origin, and where that is.
struct PartRange {
  std::size_t begin, end;
  double radius;
  RigidTransform X_WO;
};

/// Moves `free` towards `touching` by conservative advancement, and then by ever longer steps, from `min_step` on.
template <typename ClearFrom, typename TouchingAt>
void approach(const ClearFrom& clear_from, const TouchingAt& touching_at, double min_step, double& free,
              double& touching) {
  for (int i = 0; i < max_advances; ++i) {
    const double clear = clear_from(free, touching);
    free += clear;
    if (clear < min_step) break;
  }
  for (double step = min_step; free + step < touching; step *= 2.0) {
    (touching_at(free + step) ? touching : free) = free + step;
  }
}

/// Memory of the broadphase's callback.
struct Neighbours {
  std::size_t body;  // whose own parts do not count
  const std::vector<Part>* parts;
  std::vector<std::size_t>* found;
};

bool note_neighbour(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  const Neighbours& query = *static_cast<Neighbours*>(data);
  // One of the two is the query's own box, which has no part; FCL does not say which.
  for (const fcl::CollisionObjectd* object : {a, b}) {
    const std::size_t part = BoxObject::part_of(object);
    if (part < query.parts->size() && (*query.parts)[part].body != query.body) query.found->push_back(part);
  }
  return false;
}

}  // namespace

struct CollisionWorld::Impl {
  std::vector<Part> parts;
  std::vector<PartRange> bodies;
  double bench_height;
  NarrowPhase narrow;
  fcl::DynamicAABBTreeCollisionManagerd broadphase;
  BoxObject probe{bench};
  // Scratch memory of the queries.
  std::vector<std::size_t> near;
  std::vector<ContactPoint> found;

  explicit Impl(const scene::Scene& scene) : bench_height(scene.bench_height) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) add(i, scene.bodies[i]);
    std::vector<fcl::CollisionObjectd*> objects;
    for (const Part& part : parts) objects.push_back(part.in_broadphase.get());
    broadphase.registerObjects(objects);  // all at once: a balanced tree
    broadphase.setup();
  }

  void add(std::size_t index, const scene::Body& body) {
    const std::size_t begin = parts.size();
    for (const geometry::Shape& shape : body.collision) {
      parts.push_back({index, shape.geometry, shape.X_OS, body.X_WO * shape.X_OS, narrow.add(shape.geometry),
                       BoxObject(parts.size()), geometry::bounding_box(shape.geometry)});
      parts.back().in_broadphase.place(parts.back().box_at(parts.back().X_WS));
    }
    bodies.push_back({begin, parts.size(), geometry::bounding_radius(body.collision), body.X_WO});
  }

  void place(std::size_t body, const RigidTransform& X_WO) {
    if (X_WO.matrix() == bodies[body].X_WO.matrix()) return;
    bodies[body].X_WO = X_WO;
    for (std::size_t i = bodies[body].begin; i < bodies[body].end; ++i) {
      parts[i].X_WS = X_WO * parts[i].X_OS;
      // Out and in again: update() would look at the whole tree.
      broadphase.unregisterObject(parts[i].in_broadphase.get());
      parts[i].in_broadphase.place(parts[i].box_at(parts[i].X_WS));
      broadphase.registerObject(parts[i].in_broadphase.get());
    }
  }

  /// Pieces of other bodies whose boxes come into `box`, in the order of their indices, into `near`.
  void find_near(std::size_t body, const Eigen::AlignedBox3d& box) {
    near.clear();
    probe.place(box);
    Neighbours query{body, &parts, &near};
    broadphase.collide(probe.get(), &query, note_neighbour);
    std::sort(near.begin(), near.end());
  }

  /// Contacts of one part placed at `X_WS`, appended to `found`. With `first_only` it ends with the first part in
  /// contact.
  void find(const Part& part, const RigidTransform& X_WS, const Tolerance& tolerance, bool first_only) {
    const Eigen::AlignedBox3d box = part.box_at(X_WS);
    if (bench_height - box.min().z() > tolerance.in(bench)) {
      const std::size_t first = found.size();
      append_bench_contacts(part.geometry, X_WS, bench_height, tolerance.in(bench), found);
      if (first_only && found.size() > first) return;
      if (found.size() - first > max_bench_points) reduce_manifold(first, found);
    }
    find_near(part.body, geometry::grown(box, std::max(0.0, -tolerance.depth())));
    for (const std::size_t i : near) {
      const std::size_t first = found.size();
      narrow.append_contacts(part.solid, X_WS, parts[i].solid, parts[i].X_WS, tolerance.in(parts[i].body), found);
      for (std::size_t k = first; k < found.size(); ++k) found[k].other = parts[i].body;
      if (first_only && found.size() > first) return;
    }
  }

  void find_all(std::size_t body, const RigidTransform& X_WO, const Tolerance& tolerance, bool first_only) {
    found.clear();
    for (std::size_t i = bodies[body].begin; i < bodies[body].end; ++i) {
      find(parts[i], X_WO * parts[i].X_OS, tolerance, first_only);
      if (first_only && !found.empty()) return;
    }
  }

  /// Fraction, at most `limit`, of the displacement `move`, `turn` (in the body's axes) that the body can certainly
  /// make from `X_WO` on without being deeper in anything than `tolerance`: conservative advancement, part by part.
  /// Boxes stay apart as long as their corners do not cross a plane between them; if the boxes around other shapes
  /// overlap, the gap between their surfaces counts.
  double free_distance(std::size_t body, const RigidTransform& X_WO, const Vector3d& move_W, const Vector3d& turn_O,
                       const Tolerance& tolerance, double limit) {
    const geometry::StraightMotion path{X_WO.translation(), move_W, X_WO.linear() * turn_O};
    const double fastest = move_W.norm() + bodies[body].radius * turn_O.norm();
    double clear = limit;
    for (std::size_t i = bodies[body].begin; i < bodies[body].end && clear > 0.0; ++i) {
      const RigidTransform X_WS = X_WO * parts[i].X_OS;
      const geometry::OutlineBox own = parts[i].outline(X_WS);
      const Eigen::AlignedBox3d box = parts[i].box_at(X_WS);
      const double by_corners = geometry::free_fraction_above(own, path, {Vector3d::UnitZ(), bench_height},
                                                              own.exact ? tolerance.in(bench) : 0.0, clear);
      clear = std::max(by_corners, std::min(clear, (box.min().z() - bench_height) / fastest));
      find_near(body, geometry::grown(box, fastest * clear));
      for (const std::size_t other : near) {
        const geometry::OutlineBox others = parts[other].outline(parts[other].X_WS);
        const bool exact = own.exact && others.exact;
        const double depth = tolerance.in(parts[other].body);
        const double boxes = geometry::free_fraction_to(own, path, others, exact ? depth : 0.0, clear);
        if (exact || boxes >= clear) {
          clear = boxes;
        } else {
          const double surfaces =
              narrow.free_distance(parts[i].solid, X_WS, parts[other].solid, parts[other].X_WS, depth) / fastest;
          clear = std::max(boxes, std::min(clear, surfaces));
        }
      }
    }
    return clear;
  }

  /// Around a part on the whole path: the boxes at both ends, and what the arc between adds to them, which is at most
  /// r θ²/8 for a point at r (the error of linear interpolation); or the ball around the body, where that is less.
  Eigen::AlignedBox3d swept_box(const Part& part, const RigidTransform& X0, const RigidTransform& X1) const {
    const double radius = bodies[part.body].radius;
    const double angle = math::turn_between(X0, X1).norm();
    const Eigen::AlignedBox3d ends = part.box_at(X0 * part.X_OS).merged(part.box_at(X1 * part.X_OS));
    Eigen::AlignedBox3d ball(X0.translation());
    ball.extend(Vector3d(X1.translation()));
    return geometry::grown(ends, radius * angle * angle / 8.0).intersection(geometry::grown(ball, radius));
  }
};

CollisionWorld::CollisionWorld(const scene::Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
CollisionWorld::~CollisionWorld() = default;
CollisionWorld::CollisionWorld(CollisionWorld&&) noexcept = default;
CollisionWorld& CollisionWorld::operator=(CollisionWorld&&) noexcept = default;

void CollisionWorld::set_pose(std::size_t body, const RigidTransform& X_WO) { impl_->place(body, X_WO); }

bool CollisionWorld::may_touch(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                               double margin) const {
  const PartRange& range = impl_->bodies[body];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const Eigen::AlignedBox3d box = geometry::grown(impl_->swept_box(impl_->parts[i], X0_WO, X1_WO), margin);
    if (box.min().z() < impl_->bench_height) return true;
    impl_->find_near(body, box);
    if (!impl_->near.empty()) return true;
  }
  return false;
}

std::vector<std::size_t> CollisionWorld::near(const Eigen::AlignedBox3d& box_W) const {
  impl_->find_near(bench, box_W);
  std::vector<std::size_t> bodies;
  for (const std::size_t part : impl_->near) {
    if (bodies.empty() || bodies.back() != impl_->parts[part].body) bodies.push_back(impl_->parts[part].body);
  }
  if (box_W.min().z() < impl_->bench_height) bodies.push_back(bench);
  return bodies;
}

bool CollisionWorld::touches(std::size_t body, const RigidTransform& X_WO, const Tolerance& tolerance) const {
  impl_->find_all(body, X_WO, tolerance, true);
  return !impl_->found.empty();
}

void CollisionWorld::find_contacts(std::size_t body, const RigidTransform& X_WO, const Tolerance& tolerance,
                                   std::vector<ContactPoint>& contacts) const {
  impl_->find_all(body, X_WO, tolerance, false);
  contacts.insert(contacts.end(), impl_->found.begin(), impl_->found.end());
}

SweepResult CollisionWorld::sweep(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                                  const Tolerance& tolerance, double resolution, int levels) const {
  const Vector3d turn = math::turn_between(X0_WO, X1_WO);
  const Vector3d move = X1_WO.translation() - X0_WO.translation();
  const double path = move.norm() + impl_->bodies[body].radius * turn.norm();
  if (!(resolution > 0.0) || !std::isfinite(path))
    throw std::invalid_argument("sweep: expected a resolution > 0 and finite poses");
  if (!may_touch(body, X0_WO, X1_WO, std::max(0.0, -tolerance.depth()))) return {};
  const auto at = [&](double fraction) { return math::between(X0_WO, X1_WO, turn, fraction); };
  const auto touching_at = [&](double fraction) { return touches(body, at(fraction), tolerance); };
  const auto clear_from = [&](double fraction, double until) {
    return tolerance.depth() < 0.0 ? 0.0
                                   : impl_->free_distance(body, at(fraction), move, turn, tolerance, until - fraction);
  };
  if (touching_at(0.0)) return {true, 0.0, 0.0};
  const double min_step = std::min(1.0, resolution / std::max(path, resolution));
  double free = 0.0, touching = 2.0;
  while (free < 1.0 && touching > 1.0) {
    const double clear = clear_from(free, 1.0);
    const double looked_at = std::min(1.0, free + std::max(min_step, clear));
    (looked_at - free <= clear || !touching_at(looked_at) ? free : touching) = looked_at;
  }
  if (touching > 1.0) return {};
  if (levels == 0) {
    approach(clear_from, touching_at, impact_precision / std::max(path, impact_precision), free, touching);
  }
  for (int level = 0; level < levels; ++level) {
    const double middle = 0.5 * (free + touching);
    (touching_at(middle) ? touching : free) = middle;
  }
  return {true, free, touching};
}

}  // namespace spring_workbench::collision
