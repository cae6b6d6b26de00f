#pragma once

#include <vector>

#include "spring_workbench/geometry/box_gap.h"

namespace spring_workbench::geometry {

/// A place where two boxes touch, or would when they came together along `n_W`.
struct BoxContact {
  Vector3d p_W = Vector3d::Zero();   ///< on `b` [m]
  Vector3d n_W = Vector3d::UnitZ();  ///< unit, from `b` towards `a`
  double gap = 0.0;                  ///< along `n_W`; negative: as deep [m]
};

/// Returns the contacts of two boxes with a gap smaller than `margin` [m], along the direction in which they are
/// furthest apart: up to four corners of one face over the other, clipped to it, or the crossing of two edges. None is
/// there where the boxes would pass by each other along it.
std::vector<BoxContact> box_contacts(const OutlineBox& a, const OutlineBox& b, double margin);

/// The same of a box above the half-space `n · x < height`: the corners of the face that looks towards it.
std::vector<BoxContact> box_contacts(const OutlineBox& a, const Vector3d& n_W, double height, double margin);

}  // namespace spring_workbench::geometry
