#pragma once

#include <cstddef>
#include <string>

#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::scene {

/// Largest number of triangles of a mesh.
constexpr std::size_t most_triangles = 1000000;

/// The triangles of an STL, OBJ or DAE file, as they stand in it: axes as in the file (ROS ignores Collada's up axis;
/// its unit counts). Read in a child process and from this one file alone, so that a file made to crash, to hang or to
/// eat memory is refused like any other. Throws InputError naming `where`.
geometry::TriangleMesh read_triangles(const std::string& path, const std::string& where);

}  // namespace spring_workbench::scene
