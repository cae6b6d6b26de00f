#pragma once

#include <optional>

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// Where a ray meets a shape.
struct RayHit {
  double distance;    ///< along the ray [m]
  Vector3d normal_O;  ///< outward, of unit length; zero where the ray starts inside
};

/// The first of the shapes that begins along the unit vector `d_O` from `p_O` [m] on (both in the frame of the shapes),
/// at most `reach` [m] away; at 0 where the start is inside. Nothing if the path is free.
std::optional<RayHit> first_along_ray(const std::vector<Shape>& shapes, const Vector3d& p_O, const Vector3d& d_O,
                                      double reach);

}  // namespace spring_workbench::geometry
