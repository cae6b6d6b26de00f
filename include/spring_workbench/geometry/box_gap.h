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

/// Direction along which two boxes are furthest apart, and by how much: a lower bound of their distance. Negative if
/// they overlap: minus the shortest displacement that separates them (fifteen axes of the separating axis theorem).
struct BoxGap {
  double gap = 0.0;                  ///< [m]
  Vector3d n_W = Vector3d::UnitZ();  ///< unit, from `b` towards `a`
};
BoxGap gap_between(const OutlineBox& a, const OutlineBox& b);

/// The same for a box above the half-space below `height`.
BoxGap gap_above(const OutlineBox& box, double height);

}  // namespace spring_workbench::geometry
