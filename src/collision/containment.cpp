#include "containment.h"

#include <limits>
#include <utility>

#include "spring_workbench/geometry/nearest_point.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/moving_frames.h"

namespace spring_workbench::collision {
namespace {

/// A point of the shape's surface, in its frame.
Vector3d point_of(const geometry::Geometry& geometry) {
  if (const auto* box = std::get_if<geometry::Box>(&geometry)) return 0.5 * box->size;
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&geometry)) return Vector3d(cylinder->radius, 0.0, 0.0);
  return std::get<geometry::MeshPtr>(geometry)->vertices.front();
}

/// Whether a point of `inner`, of which no triangle meets the surface of `outer`, lies in `outer`.
bool is_inside(const geometry::Geometry& inner, const RigidTransform& X_WI, const geometry::Geometry& outer,
               const RigidTransform& X_WO) {
  const Vector3d p_O = X_WO.inverse() * (X_WI * point_of(inner));
  return geometry::bounding_box(outer).contains(p_O) && geometry::contains(outer, p_O);
}

/// The point of the surface that is nearest to `q`, and its triangle.
std::pair<Vector3d, int> nearest_surface_point(const geometry::Surface& surface, const Vector3d& q) {
  std::pair<Vector3d, int> nearest{Vector3d::Constant(std::numeric_limits<double>::infinity()), 0};
  for (int t = 0; t < static_cast<int>(surface.normals.size()); ++t) {
    const Vector3d p =
        geometry::nearest_on_triangle(surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2), q);
    if ((p - q).norm() < (nearest.first - q).norm()) nearest = {p, t};
  }
  return nearest;
}

/// How far the shape reaches along −n, as a coordinate along n.
double lowest_along(const geometry::Geometry& geometry, const RigidTransform& X_WS, const Vector3d& n) {
  RigidTransform X_NW = RigidTransform::Identity();
  X_NW.linear() = math::shortest_rotation(n, Vector3d::UnitZ());
  return geometry::bounding_box(geometry, X_NW * X_WS).min().z();
}

}  // namespace

void append_containment(const geometry::Geometry& inner, const RigidTransform& X_WI, const geometry::Geometry& outer,
                        const PlacedSurface& outer_surface, double tolerance, std::vector<ContactPoint>& contacts) {
  const RigidTransform& X_WO = outer_surface.X_WS;
  if (!is_inside(inner, X_WI, outer, X_WO)) return;
  const Vector3d middle_O = X_WO.inverse() * geometry::bounding_box(inner, X_WI).center();
  const auto [p_O, triangle] = nearest_surface_point(outer_surface.surface, middle_O);
  const Vector3d n_W = X_WO.linear() * outer_surface.surface.normal(triangle);
  const Vector3d p_W = X_WO * p_O;
  const double depth = n_W.dot(p_W) - lowest_along(inner, X_WI, n_W);
  if (depth > tolerance) contacts.push_back({0, p_W, n_W, depth});
}

}  // namespace spring_workbench::collision
