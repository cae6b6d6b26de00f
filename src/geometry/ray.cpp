#include "spring_workbench/geometry/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::geometry {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The interval of a line inside a convex shape, intersected step by step.
struct Interval {
  double begin = -never, end = never;
  Vector3d normal = Vector3d::Zero();  ///< outward normal at the start of the interval

  void cut(double from, double to, const Vector3d& outward) {
    if (from > begin) {
      begin = from;
      normal = outward;
    }
    end = std::min(end, to);
  }
  /// Intersects with the slab in which coordinate `axis` of p + s d is between −half and half.
  void clip_to_slab(const Vector3d& p, const Vector3d& d, int axis, double half) {
    if (d[axis] == 0.0) {
      if (std::abs(p[axis]) > half) end = -never;
      return;
    }
    const double a = (-half - p[axis]) / d[axis], b = (half - p[axis]) / d[axis];
    cut(std::min(a, b), std::max(a, b), Vector3d::Unit(axis) * (d[axis] > 0.0 ? -1.0 : 1.0));
  }
  /// Intersects with the ball of this radius about the origin.
  void clip_to_ball(const Vector3d& p, const Vector3d& d, double radius) {
    const double a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - radius * radius, discriminant = b * b - a * c;
    if (a == 0.0 || discriminant < 0.0) {
      if (a != 0.0 || c > 0.0) end = -never;
      return;
    }
    const double root = std::sqrt(discriminant), from = (-b - root) / a;
    cut(from, (-b + root) / a, (p + from * d) / radius);
  }
  RayHit entry() const {
    if (!(begin <= end && end >= 0.0)) return {never, normal};
    return begin > 0.0 ? RayHit{begin, normal} : RayHit{0.0, Vector3d::Zero()};
  }
};

RayHit entry(const Box& box, const Vector3d& p, const Vector3d& d) {
  Interval interval;
  for (int i = 0; i < 3; ++i) interval.clip_to_slab(p, d, i, 0.5 * box.size[i]);
  return interval.entry();
}

RayHit entry(const Sphere& sphere, const Vector3d& p, const Vector3d& d) {
  Interval interval;
  interval.clip_to_ball(p, d, sphere.radius);
  return interval.entry();
}

RayHit entry(const Cylinder& cylinder, const Vector3d& p, const Vector3d& d) {
  const Vector3d across(1.0, 1.0, 0.0);
  Interval interval;
  interval.clip_to_slab(p, d, 2, 0.5 * cylinder.length);
  interval.clip_to_ball(across.cwiseProduct(p), across.cwiseProduct(d), cylinder.radius);
  return interval.entry();
}

/// First hit of the ray with a triangle of the mesh (Möller and Trumbore, 1997).
RayHit entry(const MeshPtr& mesh, const Vector3d& p, const Vector3d& d) {
  if (contains(Geometry(mesh), p)) return {0.0, Vector3d::Zero()};
  RayHit nearest{never, Vector3d::Zero()};
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
    if (!(s >= 0.0 && s < nearest.distance)) continue;
    const Vector3d normal = e1.cross(e2).normalized();
    nearest = {s, normal.dot(d) > 0.0 ? Vector3d(-normal) : normal};
  }
  return nearest;
}

}  // namespace

std::optional<RayHit> first_along_ray(const std::vector<Shape>& shapes, const Vector3d& p_O, const Vector3d& d_O,
                                      double reach) {
  RayHit nearest{never, Vector3d::Zero()};
  for (const Shape& shape : shapes) {
    const Vector3d p = shape.X_OS.inverse() * p_O;
    const Vector3d d = shape.X_OS.linear().transpose() * d_O;
    RayHit hit = std::visit([&](const auto& g) { return entry(g, p, d); }, shape.geometry);
    hit.normal_O = shape.X_OS.linear() * hit.normal_O;
    if (hit.distance < nearest.distance) nearest = hit;
  }
  if (nearest.distance > reach) return std::nullopt;
  return nearest;
}

}  // namespace spring_workbench::geometry
