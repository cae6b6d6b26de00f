#pragma once

#include <vector>

#include "placed_triangle.h"
#include "spring_workbench/collision/collision_world.h"

namespace spring_workbench {

/// Contact of a triangle of this body's surface with one of the other's that it crosses: along the normal of either one
/// or of two crossing convex edges. Which of these it is cannot be told from two triangles alone: `n_W` is how the
/// surfaces meet on the whole (see contact_patches.h), and of the ways that go along with it the least deep is taken.
/// Points deeper than `tolerance` [m] are appended, without `other`; those on a face span the common part of the two
/// triangles.
void append_triangle_contacts(const Triangle& own, const Triangle& other, const Vector3d& n_W, double tolerance,
                              std::vector<ContactPoint>& contacts);

/// Of the contacts from index `first` on, keeps of each group of nearly equal normals the deepest point and those that
/// lie furthest out in eight directions: what a hundred points support, these do.
void thin_out(std::size_t first, std::vector<ContactPoint>& contacts);

}  // namespace spring_workbench
