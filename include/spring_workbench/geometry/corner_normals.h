#pragma once

#include <cstdint>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::geometry {

/// Normals with which a mesh is drawn, one for each corner of each triangle: the mean, by area, of the triangles at
/// that vertex that are nearly in one plane with it, so that a surface is smooth where neighbours meet at less than the
/// crease angle of 45°. `vertices`: three numbers each; `triangles`: three indices of vertices each.
std::vector<Eigen::Vector3f> corner_normals(const std::vector<float>& vertices,
                                            const std::vector<std::uint32_t>& triangles);

}  // namespace spring_workbench::geometry
