#pragma once

#include <vector>

#include "spring_workbench/geometry/box_gap.h"

namespace spring_workbench::geometry {

/// A point at which two boxes touch, or would touch if they approached each other along `n_W`.
struct BoxContact {
  Vector3d p_W = Vector3d::Zero();   ///< on `b` [m]
  Vector3d n_W = Vector3d::UnitZ();  ///< unit, from `b` towards `a`
  double gap = 0.0;                  ///< signed distance along `n_W` [m]; negative: penetration
};

/// Returns the contacts of two boxes with a gap smaller than `margin` [m] along the direction in which they are
/// furthest apart: up to four points of one face clipped to the other face, or the crossing of two edges where no faces
/// are nearly parallel above each other. Empty if the boxes would pass each other along this direction.
std::vector<BoxContact> box_contacts(const OutlineBox& a, const OutlineBox& b, double margin);

/// Returns the contacts of a box with the half-space `n · x < height`: the corners of the face that looks towards it.
std::vector<BoxContact> box_contacts(const OutlineBox& a, const Vector3d& n_W, double height, double margin);

}  // namespace spring_workbench::geometry
