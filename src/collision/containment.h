#pragma once

#include <vector>

#include "spring_workbench/collision/collision_world.h"
#include "triangle_contacts.h"

namespace spring_workbench::collision {

/// Appends a contact where a shape lies wholly in a closed surface, whose triangles it therefore does not touch: at the
/// surface's point that is nearest to the shape's middle, as deep as the shape's box has to go to come out there.
void append_containment(const geometry::Geometry& inner, const RigidTransform& X_WI, const geometry::Geometry& outer,
                        const PlacedSurface& outer_surface, double tolerance, std::vector<ContactPoint>& contacts);

}  // namespace spring_workbench::collision
