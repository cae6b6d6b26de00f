#pragma once

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// Turns triangles so that they are counter-clockwise from outside. Each closed part (every edge has exactly two
/// triangles) with inconsistent triangles is oriented on its own. The consistent parts keep their relative orientation,
/// so that cavities stay cavities, and are turned together if their total signed volume is negative.
void orient(TriangleMesh& mesh);

}  // namespace spring_workbench::geometry
