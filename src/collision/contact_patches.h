#pragma once

#include <utility>
#include <vector>

#include "placed_triangle.h"
#include "spring_workbench/collision/collision_world.h"

namespace spring_workbench::collision {

/// Appends the contacts of two surfaces of which `pairs` (own triangle, other triangle) cross, deeper than `tolerance`
/// [m].
///
/// The pairs are sorted into patches, each around one closed curve in which the surfaces cross. The area vector of the
/// curve, ½ ∮ x × dx, is by Stokes' theorem the sum of the outward normals over the part of the other's surface that is
/// in this body, and so the direction in which the patch pushes: the same however finely the surfaces are cut up.
void append_surface_contacts(const PlacedSurface& own, const PlacedSurface& other,
                             const std::vector<std::pair<int, int>>& pairs, double tolerance,
                             std::vector<ContactPoint>& contacts);

}  // namespace spring_workbench::collision
