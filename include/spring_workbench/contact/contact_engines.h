#pragma once

#include <memory>

#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

namespace spring_workbench::contact {

// The contact engines are shared libraries, opened by their names: the run path of what this is linked into says where
// they are. The first call opens one; a program that calls neither maps neither FCL nor Bullet. Both throw InputError
// where the library is not there: a build may leave it out.

/// The world of the sweeps among what stands still, with all bodies at the scene's poses.
std::unique_ptr<collision::CollisionWorld> open_collision_world(const scene::Scene& scene);

/// The world of what moves together (contact mode `dynamic`): all movable bodies begin asleep at the scene's poses.
std::unique_ptr<rigid_bodies::RigidWorld> open_rigid_world(const scene::Scene& scene);

}  // namespace spring_workbench::contact
