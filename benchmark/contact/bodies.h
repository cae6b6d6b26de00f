#pragma once

#include <string>
#include <utility>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

inline std::string name_of(scene::ContactMode mode) {
  if (mode == scene::ContactMode::none) return "none";
  return mode == scene::ContactMode::stop ? "stop" : "dynamic";
}

inline scene::Body standing(const std::string& name, geometry::Geometry geometry, const RigidTransform& X_WO,
                            double friction) {
  scene::Body body;
  body.name = name;
  body.X_WO = X_WO;
  body.material.friction = friction;
  body.collision.push_back({std::move(geometry)});
  return body;
}

/// `principal`: moments of inertia about O [kg·m²].
inline scene::Body movable(const std::string& name, geometry::Geometry geometry, const RigidTransform& X_WO,
                           double friction, double mass, const Vector3d& principal) {
  scene::Body body = standing(name, std::move(geometry), X_WO, friction);
  body.movable = true;
  body.mass_properties.mass = mass;
  body.mass_properties.inertia_O = principal.asDiagonal();
  return body;
}

inline Vector3d box_inertia(double mass, const Vector3d& size) {
  const Vector3d s = size.cwiseAbs2();
  return mass / 12.0 * Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
}

inline RigidTransform at(const Vector3d& p_WO) { return RigidTransform(Eigen::Translation3d(p_WO)); }

/// A movable one, along the axes of W.
inline scene::Body box(const std::string& name, const Vector3d& size, double mass, const Vector3d& p_WO,
                       double friction = 0.5) {
  return movable(name, geometry::Box{size}, at(p_WO), friction, mass, box_inertia(mass, size));
}

}  // namespace spring_workbench::benchmark
