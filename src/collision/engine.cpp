#include "spring_workbench/collision/collision_world.h"

/// Where `open_collision_world` enters this library.
extern "C" spring_workbench::CollisionWorld* spring_workbench_new_collision_world(
    const spring_workbench::Scene& scene) {
  return new spring_workbench::CollisionWorld(scene);
}
