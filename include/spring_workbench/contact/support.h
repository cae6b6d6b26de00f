#pragma once

#include <string>
#include <vector>

#include "spring_workbench/collision/collision_world.h"

namespace spring_workbench::contact {
// Which bodies support which, from their poses alone; a body is given by its index in the scene.

/// Returns whether a body supports this one from below, at a distance of at most 0.1 mm.
bool is_carried(const collision::CollisionWorld& world, std::size_t body, const RigidTransform& X_WO);
/// Returns the movable bodies that lie on this one, at a distance of at most 0.1 mm.
std::vector<std::size_t> movable_on(const collision::CollisionWorld& world, const scene::Scene& scene, std::size_t body,
                                    const RigidTransform& X_WO);
/// Returns the name of a body that this one, at `X_WO`, would overlap by more than 0.1 mm; empty if none.
std::string inside_of(const collision::CollisionWorld& world, const scene::Scene& scene, std::size_t body,
                      const RigidTransform& X_WO);

}  // namespace spring_workbench::contact
