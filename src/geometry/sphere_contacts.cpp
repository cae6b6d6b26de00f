#include "sphere_contacts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "spring_workbench/geometry/nearest_point.h"
#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::geometry {
namespace {

NearestPoint nearest_on(const Geometry& geometry, const Vector3d& q) {
  if (const auto* box = std::get_if<Box>(&geometry)) return nearest_point(*box, q);
  if (const auto* sphere = std::get_if<Sphere>(&geometry)) return nearest_point(*sphere, q);
  return nearest_point(std::get<Cylinder>(geometry), q);
}

Vector3d nearest_on(const Solid::Face& face, const Vector3d& q) {
  return nearest_on_triangle(face.corners[0], face.corners[1], face.corners[2], q);
}

struct Candidate {
  const Solid::Face* face;
  Vector3d p;       ///< nearest to the centre
  double distance;  ///< ≥ 0
  double height;    ///< of the centre over the face's plane; negative behind it
};

/// The faces that come within `distance` of a point, or, if that is deep inside, all.
std::vector<Candidate> candidates_near(const Solid& solid, const Vector3d& q, double distance) {
  std::vector<std::size_t> faces = solid.face_tree.inside(grown(Eigen::AlignedBox3d(q), distance));
  if (faces.empty() && solid.extent.contains(q) && contains(solid.geometry, q)) {
    faces.resize(solid.faces.size());
    std::iota(faces.begin(), faces.end(), std::size_t{0});
  }
  std::vector<Candidate> candidates;
  for (const std::size_t i : faces) {
    const Solid::Face& face = solid.faces[i];
    const Vector3d p = nearest_on(face, q);
    candidates.push_back({&face, p, (q - p).norm(), face.n.dot(q - p)});
  }
  return candidates;
}

/// Whether the centre is inside, as the nearest face says: of those that share its point, the one it is straightest
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
bool is_on_seam(const Candidate& candidate, const std::vector<Candidate>& all, double rounding) {
  return std::any_of(all.begin(), all.end(), [&](const Candidate& other) {
    return other.distance < candidate.distance - rounding &&
           (nearest_on(*other.face, candidate.p) - candidate.p).norm() <= rounding;
  });
}

}  // namespace

std::vector<BoxContact> sphere_contacts(double radius, const Vector3d& centre, const Solid& other, double reach) {
  std::vector<BoxContact> contacts;
  const auto add = [&](const Vector3d& p, const Vector3d& n, double gap) {
    if (gap < reach) contacts.push_back({p, n, gap});
  };
  if (!std::holds_alternative<MeshPtr>(other.geometry)) {
    const NearestPoint nearest = nearest_on(other.geometry, centre);
    add(nearest.p, nearest.n, nearest.distance - radius);
    return contacts;
  }
  const std::vector<Candidate> candidates = candidates_near(other, centre, radius + std::max(reach, 0.0));
  if (candidates.empty()) return contacts;
  const double rounding = 1e-9 * (radius + centre.norm());
  const double side = is_inside(candidates, rounding) ? -1.0 : 1.0;
  for (const Candidate& c : candidates) {
    const bool faces_away = side * c.height < -rounding;
    if (faces_away || is_on_seam(c, candidates, rounding)) continue;
    add(c.p, c.distance > rounding ? Vector3d(side * (centre - c.p) / c.distance) : c.face->n,
        side * c.distance - radius);
  }
  return contacts;
}

}  // namespace spring_workbench::geometry
