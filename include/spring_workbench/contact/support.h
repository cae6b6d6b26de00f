#pragma once

#include <string>
#include <vector>

#include "spring_workbench/collision/collision_world.h"

namespace spring_workbench::contact {

// Who stands on what, by where bodies are; a body is named by its place in the scene.

/// Whether something under the body touches it, to 0.1 mm.
bool is_carried(const collision::CollisionWorld& world, std::size_t body, const RigidTransform& X_WO);
/// The movable bodies that lie on the body, to 0.1 mm.
std::vector<std::size_t> movable_on(const collision::CollisionWorld& world, const scene::Scene& scene, std::size_t body,
                                    const RigidTransform& X_WO);
/// What the body would be in by more than 0.1 mm, were it at `X_WO`: a name, empty for nothing.
std::string inside_of(const collision::CollisionWorld& world, const scene::Scene& scene, std::size_t body,
                      const RigidTransform& X_WO);

}  // namespace spring_workbench::contact
