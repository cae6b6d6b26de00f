#pragma once

#include <vector>

#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/geometry/surface.h"

namespace spring_workbench::collision {

/// Appends the contact of a sphere at `centre_W` with a box, sphere or cylinder placed at `X_WS`: by closed formulas.
void append_sphere_contact(double radius, const Vector3d& centre_W, const geometry::Geometry& other,
                           const RigidTransform& X_WS, double tolerance, std::vector<ContactPoint>& contacts);

/// Appends the contacts of a sphere with those `triangles` of a surface that it may touch: one for each face, edge or
/// corner that is nearest to the centre among its neighbours, so that seams within a flat face do not count.
void append_sphere_triangle_contacts(double radius, const Vector3d& centre_W, const geometry::Surface& other,
                                     const RigidTransform& X_WS, const std::vector<int>& triangles, double tolerance,
                                     std::vector<ContactPoint>& contacts);

/// Turns the contacts from `first` on into those of the other body.
void turn_round(std::size_t first, std::vector<ContactPoint>& contacts);

}  // namespace spring_workbench::collision
