#pragma once

#include <memory>

#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

namespace spring_workbench::contact {

// The contact engines are shared libraries that are opened by name; the run path of the calling library or program
// determines where they are found. The first call opens one; a program that calls neither function maps neither FCL nor
// Bullet. Both throw InputError if the library is missing, because a build may leave it out.

/// Opens the world for sweeps among bodies at rest, with all bodies at the poses of the scene.
std::unique_ptr<collision::CollisionWorld> open_collision_world(const scene::Scene& scene);

/// Opens the rigid-body world of contact mode `dynamic`, with all movable bodies asleep at the poses of the scene.
std::unique_ptr<rigid_bodies::RigidWorld> open_rigid_world(const scene::Scene& scene);

}  // namespace spring_workbench::contact
