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
  double radius;  ///< [m]
};
/// A cylinder along z, centred at the origin.
struct Cylinder {
  double radius;  ///< [m]
  double length;  ///< [m]
};
/// Triangles in the shape's frame; shared and immutable after loading.
struct TriangleMesh {
  std::vector<Vector3d> vertices;          ///< [m]
  std::vector<Eigen::Vector3i> triangles;  ///< indices into `vertices`, counter-clockwise from outside
  std::string uri;                         ///< file that it was loaded from, for markers
  Vector3d scale = Vector3d::Ones();       ///< already applied to `vertices`

  /// Corner `k` of a triangle.
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
  bool color_given =
      false;  ///< whether the scene sets `color`; otherwise the colours and textures of a mesh file take precedence
};

}  // namespace spring_workbench::geometry
