#pragma once

#include <vector>

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::geometry {

/// A box around one shape of a body.
struct OutlineBox {
  RigidTransform X = RigidTransform::Identity();  ///< pose of the box: its centre and axes
  Vector3d half = Vector3d::Zero();               ///< half edges [m]
  bool exact = false;                             ///< whether the shape is this box, not only enclosed by it
};

/// Returns a box around each shape, in the frame in which the shapes are placed.
std::vector<OutlineBox> outline(const std::vector<Shape>& shapes);

/// Half extent of the box along `n_W`, times the norm of `n_W` [m].
inline double reach(const OutlineBox& box, const Vector3d& n_W) {
  return (box.X.linear().transpose() * n_W).cwiseAbs().dot(box.half);
}

/// Direction along which two boxes are furthest apart, and their gap along it, which is a lower bound of their
/// distance. If they overlap it is negative: minus the shortest displacement that separates them (separating axis
/// theorem, fifteen axes).
struct BoxGap {
  double gap = 0.0;                  ///< [m]
  Vector3d n_W = Vector3d::UnitZ();  ///< unit, from `b` towards `a`
};
BoxGap gap_between(const OutlineBox& a, const OutlineBox& b);

/// Returns the gap of a box to the half-space z < `height` in the same way.
BoxGap gap_above(const OutlineBox& box, double height);

}  // namespace spring_workbench::geometry
