#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/collision/constants.h"

// Which bodies support which, from their poses alone; a body is given by its index in the scene. In the header, since
// the collision library is opened and not linked.
namespace spring_workbench::collision {

/// Returns what the body would touch if it were moved by `dz` [m] along z.
inline std::vector<ContactPoint> contacts_at(const CollisionWorld& world, std::size_t body, RigidTransform X_WO,
                                             double dz) {
  std::vector<ContactPoint> found;
  X_WO.translation().z() += dz;
  world.find_contacts(body, X_WO, 0.0, found);
  return found;
}

/// Returns whether a body supports this one from below, at a distance of at most `support_gap`.
inline bool is_carried(const CollisionWorld& world, std::size_t body, const RigidTransform& X_WO) {
  const std::vector<ContactPoint> below = contacts_at(world, body, X_WO, -support_gap);
  return std::any_of(below.begin(), below.end(), [](const ContactPoint& c) { return c.n_W.z() > min_support; });
}

/// Returns the movable bodies that lie on this one, at a distance of at most `support_gap`.
inline std::vector<std::size_t> movable_on(const CollisionWorld& world, const scene::Scene& scene, std::size_t body,
                                           const RigidTransform& X_WO) {
  std::vector<std::size_t> found;
  for (const ContactPoint& c : contacts_at(world, body, X_WO, support_gap)) {
    const bool lies_on_it =
        c.other != CollisionWorld::bench && scene.bodies[c.other].movable && c.n_W.z() < -min_support;
    if (lies_on_it) found.push_back(c.other);
  }
  return found;
}

/// Returns the name of a body that this one, at `X_WO`, would overlap by more than `support_gap`; empty if none.
inline std::string overlapped_body(const CollisionWorld& world, const scene::Scene& scene, std::size_t body,
                                   const RigidTransform& X_WO) {
  std::vector<ContactPoint> found;
  world.find_contacts(body, X_WO, support_gap, found);
  if (found.empty()) return "";
  return found.front().other == CollisionWorld::bench ? "the workbench" : scene.bodies[found.front().other].name;
}

}  // namespace spring_workbench::collision
