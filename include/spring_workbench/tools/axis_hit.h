#pragma once

#include <algorithm>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/bodies/surroundings.h"
#include "spring_workbench/geometry/ray.h"
#include "spring_workbench/tools/probe.h"

namespace spring_workbench::tools {

/// Returns the nearest body within `reach` [m] along the z axis of the stylus. `objects`: states of the scene's movable
/// bodies, in its order; `around`: the scene's surroundings; bodies for which `passes(body, X_OH)` is true are ignored.
template <typename Passes>
AxisHit first_on_axis(const scene::Scene& scene, const std::vector<bodies::BodyState>& objects,
                      const bodies::Surroundings& around, const RigidTransform& X_WS, double reach, Passes&& passes) {
  AxisHit found{reach};
  const Vector3d axis = X_WS.linear().col(2);
  const auto look = [&](std::size_t index, const RigidTransform& X_WO) {
    const Vector3d from_hand = X_WO.translation() - X_WS.translation();
    const double along = std::clamp(from_hand.dot(axis), 0.0, found.distance);
    if (!around.may_contain(index, from_hand - along * axis)) return;
    const scene::Body& body = scene.bodies[index];
    const RigidTransform X_OH = X_WO.inverse() * X_WS;
    const auto hit =
        geometry::first_along_ray(body.collision, X_OH.translation(), X_OH.linear().col(2), found.distance);
    if (hit && !passes(body, X_OH)) {
      found = {hit->distance, &body, &body.material, X_OH * Vector3d(0.0, 0.0, hit->distance), hit->normal_O};
    }
  };
  auto object = objects.begin();
  for (const bool movable : {false, true}) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (scene.bodies[i].movable == movable) look(i, movable ? (object++)->X_WO : scene.bodies[i].X_WO);
    }
  }
  return found;
}

}  // namespace spring_workbench::tools
