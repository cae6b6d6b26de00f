#pragma once

#include <array>
#include <memory>
#include <vector>

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// Triangles of a shape with their normals and neighbours, for contact between triangles.
struct Surface {
  MeshPtr mesh;
  std::vector<Vector3d> normals;               ///< unit, outward; one per triangle
  std::vector<std::array<int, 3>> neighbours;  ///< triangle across the edge k → k+1, or −1
  double rounded_off = 0.0;  ///< largest distance by which the true shape extends beyond its triangles [m]

  const Vector3d& corner(int triangle, int k) const {
    return mesh->corner(mesh->triangles[static_cast<std::size_t>(triangle)], k);
  }
  const Vector3d& normal(int triangle) const { return normals[static_cast<std::size_t>(triangle)]; }
};

/// The surface of a box, a cylinder (as an inscribed prism of `cylinder_sides` sides) or a mesh. Null for a sphere.
std::shared_ptr<const Surface> make_surface(const Geometry& geometry);

}  // namespace spring_workbench::geometry
