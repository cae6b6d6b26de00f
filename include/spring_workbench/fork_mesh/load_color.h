#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::fork_mesh {

/// Red, green and blue, 0 … 1, of a fork with a load at `place` in the scene's range of loads, 0 … 1: from steel blue
/// without load through yellow to red at the weight of the heaviest object. All displays use these colours.
inline Vector3d load_color(double place) {
  const Vector3d none(0.52, 0.66, 0.84), half(1.0, 0.85, 0.2), full(0.88, 0.08, 0.05);
  return place < 0.5 ? Vector3d(none + 2.0 * place * (half - none))
                     : Vector3d(half + (2.0 * place - 1.0) * (full - half));
}

/// Highlight colour of the object that a press of the button would grasp, from its own colour.
inline Vector3d highlighted(const Vector3d& color) { return 0.35 * color + 0.65 * Vector3d(1.0, 1.0, 0.55); }

}  // namespace spring_workbench::fork_mesh
