#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "spring_workbench/geometry/surface.h"

namespace spring_workbench::collision {

/// A surface placed in the world.
struct PlacedSurface {
  const geometry::Surface& surface;
  const RigidTransform& X_WS;
};

/// One triangle in the world.
struct Triangle {
  std::array<Vector3d, 3> corners;
  Vector3d n;                                 ///< unit, outward
  std::array<Vector3d, 3> neighbour_normals;  ///< across the edge k → k+1; `n` where there is none
};

Triangle place(const PlacedSurface& placed, int index);

/// A convex polygon that is cut by planes; a triangle cut by four has seven corners at most.
class Polygon {
 public:
  explicit Polygon(const std::array<Vector3d, 3>& triangle);

  /// Keeps the part with n·x ≤ n·p.
  void cut(const Vector3d& n, const Vector3d& p);

  const Vector3d* begin() const { return points_.data(); }
  const Vector3d* end() const { return points_.data() + size_; }

 private:
  std::array<Vector3d, 8> points_;
  std::size_t size_;
};

/// The part of `cut` that is behind the plane of `face` and over its area.
Polygon part_behind(const Triangle& cut, const Triangle& face);

/// The segment along which two triangles cross, from `begin` to `end`, such that the solid behind `own` is on the left
/// if one looks along it standing on `other`. Both ends are equal if they do not cross.
struct Crossing {
  Vector3d begin = Vector3d::Zero();
  Vector3d end = Vector3d::Zero();
};
Crossing crossing(const Triangle& own, const Triangle& other);

}  // namespace spring_workbench::collision
