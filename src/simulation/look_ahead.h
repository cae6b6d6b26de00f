#pragma once

#include "spring_workbench/contact/object_list.h"
#include "spring_workbench/geometry/ray.h"
#include "spring_workbench/tools/probe.h"

namespace spring_workbench::simulation {

/// The nearest thing within `reach` [m] in front of the stylus. `passes(body, X_OH)`: not in the way.
template <typename Passes>
tools::AxisHit look_ahead(const scene::Scene& scene, const contact::ObjectList& objects, const RigidTransform& X_WS,
                          double reach, Passes&& passes) {
  tools::AxisHit found{reach};
  const auto look = [&](const scene::Body& body, const RigidTransform& X_WO) {
    const RigidTransform X_OH = X_WO.inverse() * X_WS;
    const auto hit =
        geometry::first_along_ray(body.collision, X_OH.translation(), X_OH.linear().col(2), found.distance);
    if (hit && !passes(body, X_OH)) {
      found = {hit->distance, &body, &body.material, X_OH * Vector3d(0.0, 0.0, hit->distance), hit->normal_O};
    }
  };
  for (const scene::Body& body : scene.bodies) {
    if (!body.movable) look(body, body.X_WO);
  }
  for (std::size_t i = 0; i < objects.states().size(); ++i) look(objects.body(i), objects.states()[i].X_WO);
  return found;
}

}  // namespace spring_workbench::simulation
