#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::geometry {

/// A box, centred at the origin.
struct Box {
  Vector3d size;  ///< full edge lengths [m]
};
/// A sphere, centred at the origin.
struct Sphere {
  double radius;  ///< radius [m]
};
/// A cylinder along z, centred at the origin.
struct Cylinder {
  double radius;  ///< radius [m]
  double length;  ///< length along z [m]
};
/// A mesh of triangles in the shape's frame. It is shared, and not changed after loading.
struct TriangleMesh {
  std::vector<Vector3d> vertices;          ///< corners of the triangles [m]
  std::vector<Eigen::Vector3i> triangles;  ///< indices into `vertices`, counter-clockwise as seen from outside
  std::string uri;                         ///< file from which the mesh was loaded, for display
  Vector3d scale = Vector3d::Ones();       ///< scale of the file, already applied to `vertices`

  /// Returns corner `k`, 0 … 2, of a triangle [m].
  const Vector3d& corner(const Eigen::Vector3i& triangle, int k) const {
    return vertices[static_cast<std::size_t>(triangle[k])];
  }
};
using MeshPtr = std::shared_ptr<const TriangleMesh>;            ///< a mesh, shared by all its users; never null
using Geometry = std::variant<Box, Sphere, Cylinder, MeshPtr>;  ///< one of the shapes

/// A part of a body, placed in the body's object frame O (axes of the URDF link, origin at the centre of mass).
struct Shape {
  Geometry geometry;                                            ///< box, sphere, cylinder or mesh
  RigidTransform X_OS = RigidTransform::Identity();             ///< pose of the shape's frame S in O
  Eigen::Vector4d color = Eigen::Vector4d(0.7, 0.7, 0.7, 1.0);  ///< r, g, b, alpha in 0 … 1
  /// Whether the scene sets `color`. If it does not, the colours and textures of a mesh file take precedence.
  bool color_given = false;
};

}  // namespace spring_workbench::geometry
