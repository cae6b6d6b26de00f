#pragma once

#include <string>

#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::scene {

/// Reads the triangles of an STL, OBJ or DAE file, in the axes of the file (like ROS, ignores Collada's up axis but
/// applies its unit). Reads only this file, in a child process, so that a file crafted to crash, hang or exhaust memory
/// is refused like any other invalid file. `time_left`: processor time left for the scene [s], which is reduced by the
/// time used. Throws InputError naming `where`.
geometry::TriangleMesh read_triangles(const std::string& path, const std::string& where, double& time_left);

}  // namespace spring_workbench::scene
