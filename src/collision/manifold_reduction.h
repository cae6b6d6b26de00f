#pragma once

#include <vector>

#include "spring_workbench/collision/collision_world.h"

namespace spring_workbench::collision {

/// Of the contacts from index `first` on, keeps of each group of nearly equal normals the deepest point and those that
/// lie furthest out in eight directions: what a hundred points support, these do.
void reduce_manifold(std::size_t first, std::vector<ContactPoint>& contacts);

}  // namespace spring_workbench::collision
