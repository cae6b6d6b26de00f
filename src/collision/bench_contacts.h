#pragma once

#include <vector>

#include "spring_workbench/collision/collision_world.h"

namespace spring_workbench::collision {

/// Appends the points of a shape placed at `X_WS` that are more than `tolerance` [m] below z = `height`, straight from
/// the shape's formula: corners, vertices, rim points or the lowest point; all exact, also above the plane.
void append_bench_contacts(const geometry::Geometry& geometry, const RigidTransform& X_WS, double height,
                           double tolerance, std::vector<ContactPoint>& contacts);

}  // namespace spring_workbench::collision
