#pragma once

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// The point of a surface that is nearest to a query point, in the frame of the shape.
struct NearestPoint {
  Vector3d p = Vector3d::Zero();   ///< on the surface [m]
  Vector3d n = Vector3d::UnitZ();  ///< unit, outward
  double distance = 0.0;           ///< distance of the query point along `n` [m]; negative inside
};

// Closed formulas. If several points are equally near, one of them is returned.
NearestPoint nearest_point(const Box& box, const Vector3d& q);
NearestPoint nearest_point(const Sphere& sphere, const Vector3d& q);
NearestPoint nearest_point(const Cylinder& cylinder, const Vector3d& q);

/// The point of the triangle a, b, c that is nearest to `q`.
Vector3d nearest_on_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& q);

}  // namespace spring_workbench::geometry
