#pragma once

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::markers {

/// Whether a shape is drawn as its mesh file says, with the file's colours and textures: the scene gives no colour. STL
/// has none either: it is drawn from the triangles, smooth, in the usual colour.
bool has_file_colors(const geometry::Shape& shape);

}  // namespace spring_workbench::markers
