#include "spring_workbench/assembly/placement.h"

#include <cmath>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::assembly {

Placement judge_placement(const scene::Body& body, const scene::Target& target, const RigidTransform& X_WO, bool held) {
  const RigidTransform X_WL = X_WO * body.X_OL;
  Placement placement;
  placement.object = body.name;
  placement.position_error = (X_WL.translation() - target.X_WL.translation()).norm();
  placement.angle_error = math::log_so3(target.X_WL.linear().transpose() * X_WL.linear()).norm();
  placement.in_place =
      !held && placement.position_error <= target.position_tolerance && placement.angle_error <= target.angle_tolerance;
  return placement;
}

bool angle_matters(const scene::Target& target) { return target.angle_tolerance < M_PI; }

}  // namespace spring_workbench::assembly
