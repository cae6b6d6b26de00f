#include "spring_workbench/rigid_bodies/rigid_world.h"

/// Where `open_rigid_world` enters this library.
extern "C" spring_workbench::rigid_bodies::RigidWorld* spring_workbench_new_rigid_world(
    const spring_workbench::scene::Scene& scene) {
  return spring_workbench::rigid_bodies::make_rigid_world(scene).release();
}
