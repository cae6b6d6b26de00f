#include "spring_workbench/world/rigid_world.h"

/// Where `open_rigid_world` enters this library.
extern "C" spring_workbench::RigidWorld* spring_workbench_new_rigid_world(const spring_workbench::Scene& scene) {
  return spring_workbench::make_rigid_world(scene).release();
}
