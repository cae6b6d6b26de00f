#pragma once

#include <string>

#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::scene {

/// The triangles of an STL, OBJ or DAE file, as they stand in it: axes as in the file (ROS ignores Collada's up axis;
/// its unit counts). Read in a child process and from this one file alone, so that a file made to crash, to hang or to
/// eat memory is refused like any other. `time_left` [s]: of the processor's time for the scene; what is used is taken
/// off. Throws InputError naming `where`.
geometry::TriangleMesh read_triangles(const std::string& path, const std::string& where, double& time_left);

}  // namespace spring_workbench::scene
