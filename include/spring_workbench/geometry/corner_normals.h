#pragma once

#include <cstdint>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::geometry {

/// Normals for drawing a mesh, one for each corner of each triangle: the area-weighted mean over the triangles at that
/// vertex that are within the crease angle of 45°, so edges flatter than that look smooth. `vertices`: three
/// coordinates each; `triangles`: three vertex indices each.
std::vector<Eigen::Vector3f> corner_normals(const std::vector<float>& vertices,
                                            const std::vector<std::uint32_t>& triangles);

}  // namespace spring_workbench::geometry
