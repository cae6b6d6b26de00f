#pragma once

#include <array>

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// Volume [m³], centre and inertia of a closed shape of uniform density, in the shape's own frame; exact for every
/// kind.
struct VolumeProperties {
  double volume = 0.0;
  Vector3d centre = Vector3d::Zero();
  Matrix3d inertia_per_density = Matrix3d::Zero();  ///< about the centre [m⁵]
};
VolumeProperties volume_properties(const Geometry& geometry);

/// Whether the point `p_S` [m] (in the shape's frame) lies inside the closed shape. Meshes by winding number.
bool contains(const Geometry& geometry, const Vector3d& p_S);

/// Smallest axis-aligned box, in a frame A, of a shape placed at `X_AS`; by default in the shape's own frame.
Eigen::AlignedBox3d bounding_box(const Geometry& geometry, const RigidTransform& X_AS = RigidTransform::Identity());

/// Smallest axis-aligned box, in a frame A, of a box that is axis-aligned in the frame B at `X_AB`.
Eigen::AlignedBox3d bounding_box(const Eigen::AlignedBox3d& box_B, const RigidTransform& X_AB);

/// The box enlarged by `by` [m] on every side.
Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box, double by);

/// The corners of a box with these half edge lengths, in its own frame.
std::array<Vector3d, 8> corners(const Vector3d& half);

/// Axis-aligned box around shapes, in the frame O in which they are placed; empty if there are none.
Eigen::AlignedBox3d bounding_box(const std::vector<Shape>& shapes);

/// Whether the point `p_O` lies inside one of the shapes.
bool contains(const std::vector<Shape>& shapes, const Vector3d& p_O);

/// Largest distance of a point of the shapes from the origin of O [m]; 0 if there are none.
double bounding_radius(const std::vector<Shape>& shapes);

}  // namespace spring_workbench::geometry
