#include "spring_workbench/geometry/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::geometry {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The part of a line that is in a convex shape, or that part of it which has been looked at so far.
struct Interval {
  double begin = -never, end = never;
  /// Keeps what lies between `low` and `high` in a coordinate that is `p + s d` along the line.
  void cut(double p, double d, double low, double high) {
    if (d == 0.0) {
      if (p < low || p > high) end = -never;
      return;
    }
    const double a = (low - p) / d, b = (high - p) / d;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  /// Keeps where a s² + 2 b s + c ≤ 0.
  void cut_quadratic(double a, double b, double c) {
    const double discriminant = b * b - a * c;
    if (a == 0.0 || discriminant < 0.0) {
      if (a != 0.0 || c > 0.0) end = -never;
      return;
    }
    const double root = std::sqrt(discriminant);
    begin = std::max(begin, (-b - root) / a);
    end = std::min(end, (-b + root) / a);
  }
  double entry() const { return begin <= end && end >= 0.0 ? std::max(begin, 0.0) : never; }
};

double entry(const Box& box, const Vector3d& p, const Vector3d& d) {
  Interval interval;
  for (int i = 0; i < 3; ++i) interval.cut(p[i], d[i], -0.5 * box.size[i], 0.5 * box.size[i]);
  return interval.entry();
}

double entry(const Sphere& sphere, const Vector3d& p, const Vector3d& d) {
  Interval interval;
  interval.cut_quadratic(d.squaredNorm(), p.dot(d), p.squaredNorm() - sphere.radius * sphere.radius);
  return interval.entry();
}

double entry(const Cylinder& cylinder, const Vector3d& p, const Vector3d& d) {
  Interval interval;
  interval.cut(p.z(), d.z(), -0.5 * cylinder.length, 0.5 * cylinder.length);
  interval.cut_quadratic(d.head<2>().squaredNorm(), p.head<2>().dot(d.head<2>()),
                         p.head<2>().squaredNorm() - cylinder.radius * cylinder.radius);
  return interval.entry();
}

/// The nearest triangle that the ray goes through (Möller and Trumbore, 1997).
double entry(const MeshPtr& mesh, const Vector3d& p, const Vector3d& d) {
  if (contains(Geometry(mesh), p)) return 0.0;
  double nearest = never;
  for (const Eigen::Vector3i& t : mesh->triangles) {
    const Vector3d& corner = mesh->corner(t, 0);
    const Vector3d e1 = mesh->corner(t, 1) - corner, e2 = mesh->corner(t, 2) - corner;
    const Vector3d q = d.cross(e2);
    const double determinant = e1.dot(q);
    if (determinant == 0.0) continue;
    const Vector3d r = p - corner;
    const double u = r.dot(q) / determinant;
    const double v = d.dot(r.cross(e1)) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
    const double s = e2.dot(r.cross(e1)) / determinant;
    if (s >= 0.0) nearest = std::min(nearest, s);
  }
  return nearest;
}

}  // namespace

std::optional<double> distance_along_ray(const std::vector<Shape>& shapes, const Vector3d& p_O, const Vector3d& d_O,
                                         double reach) {
  double nearest = never;
  for (const Shape& shape : shapes) {
    const Vector3d p = shape.X_OS.inverse() * p_O;
    const Vector3d d = shape.X_OS.linear().transpose() * d_O;
    nearest = std::min(nearest, std::visit([&](const auto& g) { return entry(g, p, d); }, shape.geometry));
  }
  if (nearest > reach) return std::nullopt;
  return nearest;
}

}  // namespace spring_workbench::geometry
