#pragma once

#include <cmath>
#include <memory>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::test_support {

/// Adds the triangles of a quadrilateral, counter-clockwise from outside.
inline void add_quad(geometry::TriangleMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.emplace_back(a, b, c);
  mesh.triangles.emplace_back(a, c, d);
}

/// The twelve triangles of a box of the given edge lengths, placed by `X`.
inline geometry::MeshPtr box_mesh(const Vector3d& size, const RigidTransform& X = RigidTransform::Identity()) {
  geometry::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5);
    mesh.vertices.push_back(X * corner.cwiseProduct(size));
  }
  add_quad(mesh, 0, 4, 6, 2);
  add_quad(mesh, 1, 3, 7, 5);
  add_quad(mesh, 0, 1, 5, 4);
  add_quad(mesh, 2, 6, 7, 3);
  add_quad(mesh, 0, 2, 3, 1);
  add_quad(mesh, 4, 5, 7, 6);
  return std::make_shared<const geometry::TriangleMesh>(mesh);
}

/// A sphere of `rings` rings between the poles and twice as many segments; its vertices lie on the sphere.
inline geometry::MeshPtr sphere_mesh(double radius, int rings) {
  constexpr double pi = 3.14159265358979323846;
  geometry::TriangleMesh mesh;
  const int segments = 2 * rings;
  mesh.vertices = {Vector3d(0.0, 0.0, radius), Vector3d(0.0, 0.0, -radius)};
  for (int i = 1; i <= rings; ++i) {
    const double polar = pi * i / (rings + 1);
    for (int j = 0; j < segments; ++j) {
      const double around = 2.0 * pi * j / segments;
      mesh.vertices.push_back(
          radius * Vector3d(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)));
    }
  }
  const auto index = [&](int ring, int segment) { return 2 + ring * segments + segment % segments; };
  for (int j = 0; j < segments; ++j) {
    mesh.triangles.emplace_back(0, index(0, j), index(0, j + 1));
    mesh.triangles.emplace_back(1, index(rings - 1, j + 1), index(rings - 1, j));
    for (int i = 0; i + 1 < rings; ++i) {
      add_quad(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
    }
  }
  return std::make_shared<const geometry::TriangleMesh>(mesh);
}

}  // namespace spring_workbench::test_support
