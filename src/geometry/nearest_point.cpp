#include "spring_workbench/geometry/nearest_point.h"

#include <algorithm>
#include <cmath>

namespace spring_workbench::geometry {
namespace {

NearestPoint from_outside(const Vector3d& p, const Vector3d& q) {
  const double distance = (q - p).norm();
  return {p, (q - p) / distance, distance};
}

Vector3d nearest_on_segment(const Vector3d& a, const Vector3d& b, const Vector3d& q) {
  const Vector3d ab = b - a;
  const double length_squared = ab.squaredNorm();
  if (length_squared == 0.0) return a;
  return a + std::clamp((q - a).dot(ab) / length_squared, 0.0, 1.0) * ab;
}

}  // namespace

NearestPoint nearest_point(const Box& box, const Vector3d& q) {
  const Vector3d half = 0.5 * box.size;
  const Vector3d clamped = q.cwiseMin(half).cwiseMax(-half);
  if (clamped != q) return from_outside(clamped, q);
  int axis = 0;
  (half - q.cwiseAbs()).minCoeff(&axis);
  NearestPoint nearest{q, Vector3d::Zero(), std::abs(q[axis]) - half[axis]};
  nearest.n[axis] = q[axis] < 0.0 ? -1.0 : 1.0;
  nearest.p[axis] = nearest.n[axis] * half[axis];
  return nearest;
}

NearestPoint nearest_point(const Sphere& sphere, const Vector3d& q) {
  const double distance = q.norm();
  const Vector3d n = distance > 0.0 ? Vector3d(q / distance) : Vector3d(Vector3d::UnitZ());
  return {sphere.radius * n, n, distance - sphere.radius};
}

NearestPoint nearest_point(const Cylinder& cylinder, const Vector3d& q) {
  const double half = 0.5 * cylinder.length;
  const double across = std::hypot(q.x(), q.y());
  const Vector3d radial = across > 0.0 ? Vector3d(q.x() / across, q.y() / across, 0.0) : Vector3d(Vector3d::UnitX());
  const Vector3d clamped =
      std::min(across, cylinder.radius) * radial + std::clamp(q.z(), -half, half) * Vector3d::UnitZ();
  if (across > cylinder.radius || std::abs(q.z()) > half) return from_outside(clamped, q);
  if (cylinder.radius - across < half - std::abs(q.z())) {
    return {cylinder.radius * radial + q.z() * Vector3d::UnitZ(), radial, across - cylinder.radius};
  }
  const double side = q.z() < 0.0 ? -1.0 : 1.0;
  return {Vector3d(q.x(), q.y(), side * half), side * Vector3d::UnitZ(), std::abs(q.z()) - half};
}

Vector3d nearest_on_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& q) {
  const Vector3d n = (b - a).cross(c - a);
  const bool inside =
      n.dot((b - a).cross(q - a)) >= 0.0 && n.dot((c - b).cross(q - b)) >= 0.0 && n.dot((a - c).cross(q - c)) >= 0.0;
  if (inside) return q - (q - a).dot(n) / n.squaredNorm() * n;
  Vector3d nearest = nearest_on_segment(a, b, q);
  for (const Vector3d& p : {nearest_on_segment(b, c, q), nearest_on_segment(c, a, q)}) {
    if ((p - q).squaredNorm() < (nearest - q).squaredNorm()) nearest = p;
  }
  return nearest;
}

}  // namespace spring_workbench::geometry
