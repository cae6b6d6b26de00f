#include "triangle_contacts.h"

#include <algorithm>
#include <array>
#include <optional>

#include "constants.h"

namespace spring_workbench::collision {
namespace {

double deepest(const Polygon& polygon, const Triangle& face) {
  double depth = 0.0;
  for (const Vector3d& p : polygon) depth = std::max(depth, face.n.dot(face.corners[0] - p));
  return depth;
}

/// Edge k of a triangle with the directions that point from it into its two faces.
struct Edge {
  Vector3d start, along, into_face, into_neighbour;
  bool convex = false;
};

Edge edge_of(const Triangle& t, std::size_t k) {
  Edge edge;
  edge.start = t.corners[k];
  edge.along = t.corners[(k + 1) % 3] - t.corners[k];
  edge.into_face = t.n.cross(edge.along);
  edge.into_neighbour = edge.along.cross(t.neighbour_normals[k]);
  edge.convex = edge.into_neighbour.dot(t.n) < -flat_edge * edge.along.norm();
  return edge;
}

/// Whether the edge's solid lies wholly on the side of the edge that `n` points away from.
bool is_extreme(const Edge& edge, const Vector3d& n) {
  const double slack = 1e-9 * edge.along.norm();
  return n.dot(edge.into_face) <= slack && n.dot(edge.into_neighbour) <= slack;
}

/// Contact of two convex edges that cross each other within their lengths.
std::optional<ContactPoint> edge_contact(const Edge& own, const Edge& other) {
  Vector3d n = own.along.cross(other.along);
  const double size = n.norm();
  if (!(size > 1e-6 * own.along.norm() * other.along.norm())) return std::nullopt;
  n /= size;
  if (!is_extreme(other, n)) n = -n;
  if (!is_extreme(other, n) || !is_extreme(own, -n)) return std::nullopt;
  const Vector3d between = other.start - own.start;
  const Vector3d cross = own.along.cross(other.along);
  const double s = between.cross(other.along).dot(cross) / (size * size);
  const double t = between.cross(own.along).dot(cross) / (size * size);
  const double depth = between.dot(n);
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0 || !(depth > 0.0)) return std::nullopt;
  return ContactPoint{0, other.start + t * other.along, n, depth};
}

/// Directions in which two triangles may be in contact: on the other's face, on the own face, or on edges.
struct Paths {
  Polygon own_part, other_part;
  std::array<ContactPoint, 2 + 9> deepest = {};  // of each path: first the two faces, then edges
  std::size_t count = 0;

  void add(const ContactPoint& contact) { deepest[count++] = contact; }
};

Paths find_paths(const Triangle& own, const Triangle& other) {
  Paths paths{part_behind(own, other), part_behind(other, own)};
  paths.add({0, other.corners[0], other.n, deepest(paths.own_part, other)});
  paths.add({0, own.corners[0], -own.n, deepest(paths.other_part, own)});
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge own_edge = edge_of(own, i);
    for (std::size_t j = 0; own_edge.convex && j < 3; ++j) {
      const Edge other_edge = edge_of(other, j);
      if (!other_edge.convex) continue;
      const std::optional<ContactPoint> contact = edge_contact(own_edge, other_edge);
      if (contact) paths.add(*contact);
    }
  }
  return paths;
}

/// The shallowest of the paths that are about as near to `n` as the nearest one; nothing if all are far from it.
std::optional<std::size_t> choose_path(const Paths& paths, const std::optional<Vector3d>& n) {
  const auto goes_along = [&](const ContactPoint& path) { return n ? n->dot(path.n_W) : 1.0; };
  double best = min_along;
  for (std::size_t i = 0; i < paths.count; ++i) {
    if (paths.deepest[i].depth > 0.0) best = std::max(best, goes_along(paths.deepest[i]));
  }
  std::optional<std::size_t> chosen;
  for (std::size_t i = 0; i < paths.count; ++i) {
    const ContactPoint& path = paths.deepest[i];
    if (!(path.depth > 0.0) || goes_along(path) < std::max(min_along, best - as_good)) continue;
    if (!chosen || path.depth < paths.deepest[*chosen].depth) chosen = i;
  }
  return chosen;
}

}  // namespace

bool append_triangle_contacts(const Triangle& own, const Triangle& other, const std::optional<Vector3d>& n_W,
                              double tolerance, std::vector<ContactPoint>& contacts) {
  const Paths paths = find_paths(own, other);
  const std::optional<std::size_t> chosen = choose_path(paths, n_W);
  if (!chosen) return false;
  const auto add = [&](const ContactPoint& contact) {
    if (contact.depth > tolerance) contacts.push_back(contact);
  };
  if (*chosen == 0) {
    for (const Vector3d& p : paths.own_part) {
      const double depth = other.n.dot(other.corners[0] - p);
      add({0, p + depth * other.n, other.n, depth});
    }
  } else if (*chosen == 1) {
    for (const Vector3d& p : paths.other_part) add({0, p, -own.n, own.n.dot(own.corners[0] - p)});
  } else {
    add(paths.deepest[*chosen]);
  }
  return true;
}

}  // namespace spring_workbench::collision
