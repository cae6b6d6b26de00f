#pragma once

#include <optional>
#include <vector>

#include "placed_triangle.h"
#include "spring_workbench/collision/collision_world.h"

namespace spring_workbench::collision {

/// Contact of a triangle of this body's surface with one of the other's that it crosses: along the normal of either one
/// or of two crossing convex edges. Two triangles alone do not determine which of these it is: `n_W` is how the
/// surfaces meet on the whole (see contact_patches.h), and of the normals that are near it the shallowest one is taken.
/// Points deeper than `tolerance` [m] are appended, without `other`; those on a face span the common part of the two
/// triangles.
/// Returns false if all normals are far from `n_W`; without `n_W` the shallowest of all is taken.
bool append_triangle_contacts(const Triangle& own, const Triangle& other, const std::optional<Vector3d>& n_W,
                              double tolerance, std::vector<ContactPoint>& contacts);

}  // namespace spring_workbench::collision
