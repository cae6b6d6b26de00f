#pragma once

#include <optional>

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// Point at which a ray enters a shape.
struct RayHit {
  double distance;    ///< along the ray [m]
  Vector3d normal_O;  ///< outward unit normal; zero if the ray starts inside
};

/// Returns the first point at which the ray from `p_O` [m] along the unit vector `d_O` (both in the frame of the
/// shapes) hits a shape within `reach` [m]; at distance 0 if it starts inside one. Nothing if it hits none.
std::optional<RayHit> first_along_ray(const std::vector<Shape>& shapes, const Vector3d& p_O, const Vector3d& d_O,
                                      double reach);

}  // namespace spring_workbench::geometry
