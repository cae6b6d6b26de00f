#include "sphere_contacts.h"

#include <algorithm>
#include <cmath>

#include "nearest_point.h"

namespace spring_workbench::collision {
namespace {

NearestPoint nearest_on(const geometry::Geometry& geometry, const Vector3d& q) {
  if (const auto* box = std::get_if<geometry::Box>(&geometry)) return nearest_point(*box, q);
  if (const auto* sphere = std::get_if<geometry::Sphere>(&geometry)) return nearest_point(*sphere, q);
  return nearest_point(std::get<geometry::Cylinder>(geometry), q);
}

struct Candidate {
  int triangle;
  Vector3d p;       // nearest to the centre
  double distance;  // ≥ 0
  double height;    // of the centre over the triangle's plane; negative behind it
};

/// Whether the centre is inside, as the nearest triangle says: of those that share its point, the one it is straightest
/// over.
bool is_inside(const std::vector<Candidate>& candidates, double rounding) {
  const auto nearest = std::min_element(candidates.begin(), candidates.end(),
                                        [](const auto& a, const auto& b) { return a.distance < b.distance; });
  double height = 0.0;
  for (const Candidate& c : candidates) {
    if (c.distance <= nearest->distance + rounding && std::abs(c.height) > std::abs(height)) height = c.height;
  }
  return height < 0.0;
}

/// Whether a neighbour that the point also belongs to comes nearer to the centre: the point is then on a seam.
bool is_on_seam(const geometry::Surface& surface, const Candidate& candidate, const std::vector<Candidate>& all,
                double rounding) {
  return std::any_of(all.begin(), all.end(), [&](const Candidate& other) {
    if (!(other.distance < candidate.distance - rounding)) return false;
    const int t = other.triangle;
    const Vector3d p =
        nearest_on_triangle(surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2), candidate.p);
    return (p - candidate.p).norm() <= rounding;
  });
}

}  // namespace

void append_sphere_contact(double radius, const Vector3d& centre_W, const geometry::Geometry& other,
                           const RigidTransform& X_WS, double tolerance, std::vector<ContactPoint>& contacts) {
  const NearestPoint nearest = nearest_on(other, X_WS.inverse() * centre_W);
  const double depth = radius - nearest.distance;
  if (depth > tolerance) contacts.push_back({0, X_WS * nearest.p, X_WS.linear() * nearest.n, depth});
}

void append_sphere_triangle_contacts(double radius, const Vector3d& centre_W, const geometry::Surface& other,
                                     const RigidTransform& X_WS, const std::vector<int>& triangles, double tolerance,
                                     std::vector<ContactPoint>& contacts) {
  if (triangles.empty()) return;
  const Vector3d centre = X_WS.inverse() * centre_W;
  const double rounding = 1e-9 * (radius + centre.norm());
  std::vector<Candidate> candidates;
  for (const int t : triangles) {
    const Vector3d p = nearest_on_triangle(other.corner(t, 0), other.corner(t, 1), other.corner(t, 2), centre);
    candidates.push_back({t, p, (centre - p).norm(), other.normal(t).dot(centre - p)});
  }
  const double side = is_inside(candidates, rounding) ? -1.0 : 1.0;
  for (const Candidate& c : candidates) {
    const double depth = radius - side * c.distance;
    const bool faces_away = side * c.height < -rounding;
    if (!(depth > tolerance) || faces_away || is_on_seam(other, c, candidates, rounding)) continue;
    const Vector3d n = c.distance > rounding ? Vector3d(side * (centre - c.p) / c.distance) : other.normal(c.triangle);
    contacts.push_back({0, X_WS * c.p, X_WS.linear() * n, depth});
  }
}

void turn_round(std::size_t first, std::vector<ContactPoint>& contacts) {
  for (std::size_t i = first; i < contacts.size(); ++i) {
    contacts[i].p_W -= contacts[i].depth * contacts[i].n_W;
    contacts[i].n_W = -contacts[i].n_W;
  }
}

}  // namespace spring_workbench::collision
