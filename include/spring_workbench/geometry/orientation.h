#pragma once

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// Turns triangles such that they are counter-clockwise from outside. A closed part (each edge has exactly two
/// triangles, which may lie either way) whose triangles do not agree is turned by itself; all others stay as they are
/// to each other, so that cavities stay cavities, and are turned together if their signed volume is negative.
void orient(TriangleMesh& mesh);

}  // namespace spring_workbench::geometry
