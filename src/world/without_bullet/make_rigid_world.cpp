#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/world/rigid_world.h"

namespace spring_workbench {

std::unique_ptr<RigidWorld> make_rigid_world(const Scene& scene) {
  refuse(scene.path, "contact", "dynamic", "none or stop: this build has no Bullet in double precision");
}

}  // namespace spring_workbench
