#pragma once

#include <optional>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench {

/// How far from `p_O` [m] along the unit vector `d_O` (both in the object frame) the body's collision shapes begin, at
/// most `reach` [m]; 0 where the start is inside. Nothing when the way is free.
std::optional<double> distance_along_ray(const Body& body, const Vector3d& p_O, const Vector3d& d_O, double reach);

}  // namespace spring_workbench
