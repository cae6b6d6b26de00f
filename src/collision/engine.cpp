#include "spring_workbench/collision/collision_world.h"

/// Where `open_collision_world` enters this library.
extern "C" spring_workbench::collision::CollisionWorld* spring_workbench_new_collision_world(
    const spring_workbench::scene::Scene& scene) {
  return new spring_workbench::collision::CollisionWorld(scene);
}
