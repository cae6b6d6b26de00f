#pragma once

#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench {

/// Corners of triangles, three each, counter-clockwise from outside [m].
using TriangleCorners = std::vector<Vector3d>;

/// Adds a round tube of `radius` [m] with `sides` ≥ 3 flat sides and closed ends along the line through `path`
/// (neighbouring points differ). Fewer than two points add nothing.
void add_tube(const std::vector<Vector3d>& path, double radius, int sides, TriangleCorners& corners);

/// How the fork is drawn, in parts of its rest length.
struct ForkLook {
  int turns = 12;            ///< of the coil
  double coil_begin = 0.06;  ///< where along the rod the coil begins
  double coil_end = 0.80;    ///< and where it ends; the prongs follow
  double coil_radius = 0.08;
  double wire_radius = 0.014;
  double prong_gap = 0.06;  ///< of the outer prongs from the axis
  double prong_radius = 0.014;
};

/// The fork as a coil spring around the rod's centreline with three prongs at the tip. `centreline`: at least two poses
/// from handle to tip, evenly spaced in arc length, z along the rod. In the frame of the poses.
TriangleCorners fork_mesh(const std::vector<RigidTransform>& centreline, double length, const ForkLook& look);

}  // namespace spring_workbench
