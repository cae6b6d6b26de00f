#pragma once

#include <vector>

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// A box around one shape of a body.
struct OutlineBox {
  RigidTransform X = RigidTransform::Identity();  ///< of the box's middle and axes
  Vector3d half = Vector3d::Zero();               ///< half edges [m]
  bool exact = false;                             ///< the shape is this box
};

/// The boxes around shapes, in the frame that these are placed in.
std::vector<OutlineBox> outline(const std::vector<Shape>& shapes);

/// How far the box reaches from its middle along `n_W`, times the length of that [m].
inline double reach(const OutlineBox& box, const Vector3d& n_W) {
  return (box.X.linear().transpose() * n_W).cwiseAbs().dot(box.half);
}

/// Along which direction two boxes are furthest apart, and by how much: at least the gap between them. Negative where
/// they overlap; its size is then the least way that separates them (the fifteen axes of the separating axis theorem).
struct BoxGap {
  double gap = 0.0;                  ///< [m]
  Vector3d n_W = Vector3d::UnitZ();  ///< unit, from `b` towards `a`
};
BoxGap gap_between(const OutlineBox& a, const OutlineBox& b);

/// The same for a box above the half-space below `height`.
BoxGap gap_above(const OutlineBox& box, double height);

}  // namespace spring_workbench::geometry
