#pragma once

#include <array>
#include <memory>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::collision {

/// Triangles of a shape with what contact between triangles needs: normals and neighbours.
struct Surface {
  geometry::MeshPtr mesh;
  std::vector<Vector3d> normals;               ///< unit, outward; one per triangle
  std::vector<std::array<int, 3>> neighbours;  ///< triangle across the edge k → k+1, or −1

  const Vector3d& corner(int triangle, int k) const {
    return mesh->corner(mesh->triangles[static_cast<std::size_t>(triangle)], k);
  }
  const Vector3d& normal(int triangle) const { return normals[static_cast<std::size_t>(triangle)]; }
};

/// The surface of a box, a cylinder (as a prism of `cylinder_sides` sides through its rims' points) or a mesh.
/// Nothing for a sphere.
std::shared_ptr<const Surface> make_surface(const geometry::Geometry& geometry);

}  // namespace spring_workbench::collision
