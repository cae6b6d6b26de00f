#pragma once

#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench {

/// A box of `size` with its centre at `p_WO`; fixed if it has no mass.
inline scene::Body box(const std::string& name, const Vector3d& size, double mass, const Vector3d& p_WO,
                       double friction = 0.5) {
  scene::Body b;
  b.name = name;
  b.movable = mass > 0.0;
  b.X_WO.translation() = p_WO;
  b.mass_properties.mass = mass;
  const Vector3d s = size.cwiseAbs2();
  b.mass_properties.inertia_O = (mass / 12.0 * Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y())).asDiagonal();
  b.material.friction = friction;
  b.collision.push_back({geometry::Box{size}});
  return b;
}

inline scene::Scene scene_of(std::vector<scene::Body> bodies, scene::ContactMode contact, double friction = 0.5) {
  scene::Scene scene;
  scene.name = scene.path = "test";
  scene.contact = contact;
  scene.bodies = std::move(bodies);
  scene.bench_material.friction = friction;
  return scene;
}

}  // namespace spring_workbench
