#pragma once

#include "spring_workbench/rod/shape_model.h"
#include "support/random_poses.h"

namespace spring_workbench::fork_mesh {

/// A strain of the rod that bends, twists (up to `turns` of a turn each) and stretches by up to 20 %.
inline rod::StrainVector random_strain(const rod::ShapeModel& shape, double turns, test_support::Random& random) {
  const double most = turns * 2.0 * 3.14159265358979323846 / shape.length();
  rod::StrainVector q(shape.size());
  for (int i = 0; i < shape.size(); ++i) q[i] = most / shape.size() * random.number(-1.0, 1.0);
  q[shape.torsion().begin] = most * random.number(-1.0, 1.0);
  q[shape.stretch().begin] = random.number(-0.2, 0.2);
  return q;
}

}  // namespace spring_workbench::fork_mesh
