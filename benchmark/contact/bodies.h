#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/geometry/shape_queries.h"
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

/// A random vector, uniformly distributed in a ball about zero.
inline Vector3d in_ball(double radius, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Vector3d p;
  do {
    p = Vector3d(unit(random), unit(random), unit(random));
  } while (p.norm() > 1.0);
  return radius * p;
}

inline RigidTransform at(const Vector3d& p_WO) { return RigidTransform(Eigen::Translation3d(p_WO)); }

/// A movable box aligned with the axes of W.
inline scene::Body box(const std::string& name, const Vector3d& size, double mass, const Vector3d& p_WO,
                       double friction = 0.5) {
  return movable(name, geometry::Box{size}, at(p_WO), friction, mass, box_inertia(mass, size));
}

/// A prism over a polygon with corners at these radii and equal angles around the z axis.
inline geometry::MeshPtr prism(const std::vector<double>& radii, double height) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  const int n = static_cast<int>(radii.size());
  for (const double z : {-0.5 * height, 0.5 * height}) {
    for (int i = 0; i < n; ++i) {
      const double a = 2.0 * M_PI * i / n, r = radii[static_cast<std::size_t>(i)];
      mesh->vertices.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
  }
  mesh->vertices.emplace_back(0.0, 0.0, -0.5 * height);
  mesh->vertices.emplace_back(0.0, 0.0, 0.5 * height);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh->triangles.emplace_back(i, j, n + j);
    mesh->triangles.emplace_back(i, n + j, n + i);
    mesh->triangles.emplace_back(2 * n, j, i);
    mesh->triangles.emplace_back(2 * n + 1, n + i, n + j);
  }
  return mesh;
}

/// A torus of 24 × 12 × 2 triangles, its corners on the surface; its axis is z.
inline geometry::MeshPtr torus(double radius, double tube_radius) {
  constexpr int around = 24, across = 12;
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  const auto at = [](int i, int j) { return i % around * across + j % across; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * M_PI * i / around, v = 2.0 * M_PI * j / across, r = radius + tube_radius * std::cos(v);
      mesh->vertices.emplace_back(r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v));
      mesh->triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh->triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

/// A movable body of uniform density.
inline scene::Body uniform(const std::string& name, const geometry::Geometry& geometry, const RigidTransform& X_WO,
                           double friction, double mass) {
  const geometry::VolumeProperties of = geometry::volume_properties(geometry);
  scene::Body body = movable(name, geometry, X_WO, friction, mass, Vector3d::Ones());
  body.mass_properties.inertia_O = mass / of.volume * of.inertia_per_density;
  return body;
}

}  // namespace spring_workbench::benchmark
