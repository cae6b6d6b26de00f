#pragma once

#include <optional>

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// How far from `p_O` [m] along the unit vector `d_O` (both in the frame of the shapes) the first of the shapes begins,
/// at most `reach` [m]; 0 where the start is inside. Nothing when the way is free.
std::optional<double> distance_along_ray(const std::vector<Shape>& shapes, const Vector3d& p_O, const Vector3d& d_O,
                                         double reach);

}  // namespace spring_workbench::geometry
