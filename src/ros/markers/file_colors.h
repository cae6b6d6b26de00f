#pragma once

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::markers {

/// Whether a shape is drawn with the colours and textures of its mesh file, i.e. if the scene gives no colour. STL
/// files have none: they are drawn from the triangles, smooth, in the default colour.
bool has_file_colors(const geometry::Shape& shape);

}  // namespace spring_workbench::markers
