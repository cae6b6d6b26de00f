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

/// The contacts of two boxes that are nearer to each other than `seen_from` [m], along the direction in which they are
/// furthest apart: up to four corners of one face over the other, clipped to it, or the crossing of two edges. None is
/// there where the boxes would pass by each other along it.
std::vector<BoxContact> box_contacts(const OutlineBox& a, const OutlineBox& b, double seen_from);

/// The same of a box above the half-space `n · x < height`: the corners of the face that looks towards it.
std::vector<BoxContact> box_contacts(const OutlineBox& a, const Vector3d& n_W, double height, double seen_from);

}  // namespace spring_workbench::geometry
