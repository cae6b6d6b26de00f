#pragma once

#include "spring_workbench/scene/scene.h"

namespace spring_workbench {

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

/// Smallest axis-aligned box of a shape in the frame A that `X_AS` places it in; by default in its own frame.
Eigen::AlignedBox3d bounding_box(const Geometry& geometry, const RigidTransform& X_AS = RigidTransform::Identity());

/// Axis-aligned box of a body's collision shapes in its object frame O; empty where it has none.
Eigen::AlignedBox3d bounding_box(const Body& body);

/// Whether the point `p_O` (in the object frame) lies inside one of the body's collision shapes.
bool contains(const Body& body, const Vector3d& p_O);

/// Largest distance of a point of the body's collision shapes from the centre of mass [m].
double bounding_radius(const Body& body);

}  // namespace spring_workbench
