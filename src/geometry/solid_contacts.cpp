#include "spring_workbench/geometry/solid_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "constants.h"
#include "sphere_contacts.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/geometry/surface.h"

namespace spring_workbench::geometry {
namespace {

void add_edges(const Surface& surface, int t, std::vector<Solid::Edge>& edges) {
  for (std::size_t k = 0; k < 3; ++k) {
    const int neighbour = surface.neighbours[static_cast<std::size_t>(t)][k];
    if (neighbour < t) continue;  // no neighbour, or already done
    const Vector3d& start = surface.corner(t, static_cast<int>(k));
    const Vector3d along = surface.corner(t, static_cast<int>((k + 1) % 3)) - start;
    const Vector3d into_left = surface.normal(t).cross(along).normalized();
    const Vector3d into_right = along.cross(surface.normal(neighbour)).normalized();
    if (into_right.dot(surface.normal(t)) < -parallel) edges.push_back({start, along, into_left, into_right});
  }
}

/// The solids `a` and `b` in the frame of `b`, for contacts of points of `a` with faces of `b`.
struct View {
  const Solid &a, &b;
  const RigidTransform& X_BA;
  double reach, deepest;
  std::vector<BoxContact>& found;  ///< contacts found, in the frame of `b`

  void add(const Vector3d& p, const Vector3d& n, double gap) const {
    for (const BoxContact& c : found) {
      if ((c.p_W - p).norm() < same_place && (c.n_W - n).norm() < parallel) return;
    }
    found.push_back({p, n, gap});
  }
  Vector3d n_A(const Vector3d& n_B) const { return X_BA.linear().transpose() * n_B; }
  /// Whether no corner that is joined to this one by an edge is much lower.
  bool is_low(std::size_t corner, const Vector3d& n_B) const {
    const Vector3d n = n_A(n_B);
    return std::all_of(a.next[corner].begin(), a.next[corner].end(), [&](int other) {
      const Vector3d along = a.corners[static_cast<std::size_t>(other)] - a.corners[corner];
      return n.dot(along) >= -slope_of_flush * along.norm();
    });
  }
};

/// Tolerance by which a contact with this gap may be outside the outline of a face or beyond the end of an edge: in a
/// groove, a point equally deep in both faces would otherwise be in front of neither.
double beyond(double gap) { return same_place + std::max(0.0, -gap); }

using Extent = Eigen::AlignedBox3d;

/// Finds pairs of parts of `a` and `b` whose bounding boxes (seen from `b`) are near each other; corners and edges may
/// be behind the part that they touch.
template <typename Part, typename ExtentOf>
std::vector<std::pair<std::size_t, std::size_t>> pairs_near(const View& view, const std::vector<Part>& a,
                                                            const ExtentOf& extent_of, const PartTree& b) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < a.size() && b.tree; ++i) {
    const Extent own = grown(extent_of(a[i]), std::max(view.reach, view.deepest));
    if (!own.intersects(view.b.extent)) continue;
    for (const std::size_t k : b.inside(own)) pairs.emplace_back(i, k);
  }
  return pairs;
}

std::vector<std::pair<std::size_t, std::size_t>> edges_near(const View& view, const PartTree& b) {
  return pairs_near(
      view, view.a.edges,
      [&view](const Solid::Edge& e) {
        return Extent(view.X_BA * e.start).extend(Vector3d(view.X_BA * Vector3d(e.start + e.along)));
      },
      b);
}

bool over(const Solid::Face& face, const Vector3d& p, double beyond) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d along = face.corners[(k + 1) % 3] - face.corners[k];
    if (face.n.cross(along).dot(p - face.corners[k]) < -beyond * along.norm()) return false;
  }
  return true;
}

double distance(const Solid::Face& face, const Vector3d& p) {
  if (over(face, p, 0.0)) return std::abs(face.n.dot(p - face.corners[0]));
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d along = face.corners[(k + 1) % 3] - face.corners[k], from = p - face.corners[k];
    const double s = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (from - s * along).norm());
  }
  return nearest;
}

/// Contacts of a point of `a` with a face of `b`: in front of the face; or behind it, unless the point is in front of a
/// nearer face or has entered through one. `is_low`: whether `a` can touch a face with that normal with this point.
template <typename IsLow>
void point_and_face(const View& view, const Vector3d& p, const Solid::Face& face, const IsLow& is_low) {
  const double gap = face.n.dot(p - face.corners[0]);
  if (!(gap < view.reach && gap > -view.deepest) || !over(face, p, beyond(gap)) || !is_low(face.n)) return;
  const auto is_nearer = [&](const Solid::Face& other) {
    return distance(other, p) < -gap - same_place && (other.n.dot(p - other.corners[0]) > 0.0 || is_low(other.n));
  };
  if (gap < 0.0 && std::any_of(view.b.faces.begin(), view.b.faces.end(), is_nearer)) return;
  view.add(p - gap * face.n, face.n, gap);
}

/// The same for the side and the ends of a cylinder.
template <typename IsLow>
void point_and_cylinder(const View& view, const Vector3d& p, const IsLow& is_low) {
  const Cylinder& c = *view.b.cylinder;
  const double across = p.head<2>().norm();
  const double side = across - c.radius, end = std::abs(p.z()) - 0.5 * c.length;
  const Vector3d n_side(p.x() / across, p.y() / across, 0.0), n_end(0.0, 0.0, std::copysign(1.0, p.z()));
  const bool of_side = across > 0.0 && end < 0.0 && is_low(n_side), of_end = side < 0.0 && is_low(n_end);
  const bool nearer_side = of_side && !(of_end && end > side);
  const double gap = nearer_side ? side : end;
  if (!(of_side || of_end) || !(gap < view.reach && gap > -view.deepest)) return;
  const Vector3d& n = nearer_side ? n_side : n_end;
  view.add(p - gap * n, n, gap);
}

/// Whether a face extends to an end of the cylinder `a`, where all its lowest points are.
bool is_near_rims(const View& view, const Solid::Face& face) {
  const double near = 0.5 * view.a.cylinder->length - std::max(view.reach, view.deepest);
  double min = near, max = -near;
  for (const Vector3d& corner : face.corners) {
    const double z = view.X_BA.linear().col(2).dot(corner - view.X_BA.translation());
    min = std::min(min, z);
    max = std::max(max, z);
  }
  return max >= near || min <= -near;
}

void points_and_faces(const View& view) {
  const auto at = [&view](const Vector3d& p) { return Extent(view.X_BA * p); };
  for (const auto& [corner, face] : pairs_near(view, view.a.corners, at, view.b.face_tree)) {
    const auto is_low = [&view, i = corner](const Vector3d& n) { return view.is_low(i, n); };
    point_and_face(view, view.X_BA * view.a.corners[corner], view.b.faces[face], is_low);
  }
  if (view.b.cylinder) {
    const Eigen::AlignedBox3d near = grown(view.b.extent, view.reach);
    for (std::size_t i = 0; i < view.a.corners.size(); ++i) {
      const Vector3d p = view.X_BA * view.a.corners[i];
      if (near.contains(p)) point_and_cylinder(view, p, [&](const Vector3d& n) { return view.is_low(i, n); });
    }
  }
  for (const Solid::Face& face : view.b.faces) {
    if (!view.a.cylinder || !is_near_rims(view, face)) continue;
    for (const Vector3d& p : lowest_points(view.a, view.n_A(face.n))) {
      const auto is_low = [&](const Vector3d& n_B) {
        const Vector3d n = view.n_A(n_B), to_lowest = furthest(view.a, -n) - p;
        return n.dot(to_lowest) >= -slope_of_flush * to_lowest.norm();
      };
      point_and_face(view, view.X_BA * p, face, is_low);
    }
  }
}

/// Whether the solid of the edge is on the side that `n` points away from, up to the slope of flush faces.
bool is_supporting(const Vector3d& into_left, const Vector3d& into_right, const Vector3d& n) {
  return n.dot(into_left) <= slope_of_flush && n.dot(into_right) <= slope_of_flush;
}

void edge_and_edge(const View& view, const Solid::Edge& a, const Solid::Edge& b) {
  const Vector3d start = view.X_BA * a.start, along = view.X_BA.linear() * a.along;
  const Vector3d cross = along.cross(b.along), between = b.start - start;
  const double size2 = cross.squaredNorm(), far = std::max(view.reach, view.deepest), off = between.dot(cross);
  if (!(off * off < far * far * size2)) return;  // most of them
  if (!(size2 > parallel * parallel * along.squaredNorm() * b.along.squaredNorm())) return;
  for (const double sign : {1.0, -1.0}) {
    const Vector3d n = sign / std::sqrt(size2) * cross;
    const double gap = -between.dot(n);
    if (!(gap < view.reach && gap > -view.deepest) || !is_supporting(b.into_left, b.into_right, n)) continue;
    const double s = between.cross(b.along).dot(cross) / size2, t = between.cross(along).dot(cross) / size2;
    const auto outside = [](double at, double length) { return std::max(-at, at - 1.0) * length; };
    if (std::max(outside(s, along.norm()), outside(t, b.along.norm())) > beyond(gap)) continue;
    const Vector3d n_A = view.n_A(n);
    if (is_supporting(a.into_left, a.into_right, -n_A)) view.add(b.start + t * b.along, n, gap);
  }
}

/// An edge seen from the cylinder `b`.
struct EdgeView {
  EdgeView(const View& view, const Solid::Edge& of)
      : edge(of), start(view.X_BA * of.start), along(view.X_BA.linear() * of.along), end(start + along) {
    size = along.head<2>().squaredNorm();
    if (size > 0.0) middle = -start.head<2>().dot(along.head<2>()) / size;
    across = (start + std::clamp(middle, 0.0, 1.0) * along).head<2>().norm();
    // A contact is as far from the cylinder as its gap, and beyond an end of the edge by less than beyond().
    far = 2.0 * std::max(view.reach, view.deepest) + same_place;
  }
  bool is_near_height(double height) const {
    return std::min(start.z(), end.z()) <= height + far && std::max(start.z(), end.z()) >= height - far;
  }
  bool is_near(const Cylinder& c) const {
    return across <= c.radius + far && std::min(start.z(), end.z()) <= 0.5 * c.length + far &&
           std::max(start.z(), end.z()) >= -0.5 * c.length - far;
  }

  const Solid::Edge& edge;
  Vector3d start, along, end;
  double size = 0.0, middle = 0.0;  ///< squared length across the axis; where it is nearest to the axis, by `along`
  double across, far;               ///< smallest distance from the axis; distance beyond which nothing touches
};

/// Contact of an edge with the side of a cylinder, at the edge's point nearest to the axis.
void edge_and_side(const View& view, const EdgeView& e) {
  const Cylinder& c = *view.b.cylinder;
  if (!(e.size > 0.0)) return;
  const double s = e.middle;
  const Vector3d p = e.start + s * e.along;
  const double across = p.head<2>().norm(), gap = across - c.radius;
  if (std::max(-s, s - 1.0) * e.along.norm() > beyond(gap)) return;
  if (!(gap < view.reach && gap > -view.deepest) || across == 0.0 || std::abs(p.z()) > 0.5 * c.length) return;
  const Vector3d n(p.x() / across, p.y() / across, 0.0), n_A = view.n_A(n);
  if (is_supporting(e.edge.into_left, e.edge.into_right, -n_A)) view.add(p - gap * n, n, gap);
}

/// Contact of an edge with a rim of a cylinder, the circle at `height`: where the edge and the tangent at the rim's
/// point are nearest to each other, from the point at `angle` on.
void edge_and_rim(const View& view, const EdgeView& e, double height, double angle) {
  const double radius = view.b.cylinder->radius;
  const Vector3d &start = e.start, &along = e.along;
  Vector3d p = Vector3d::Zero(), out = p, cross = p;
  double turn = 1.0, s = 0.0, size2 = 0.0;
  for (int i = 0; i < max_turns && std::abs(turn) > 1e-14; ++i) {
    out = Vector3d(std::cos(angle), std::sin(angle), 0.0);
    p = radius * out + height * Vector3d::UnitZ();
    const Vector3d tangent(-out.y(), out.x(), 0.0), between = p - start;
    cross = along.cross(tangent);
    size2 = cross.squaredNorm();
    if (!(size2 > parallel * parallel * along.squaredNorm())) return;
    s = between.cross(tangent).dot(cross) / size2;
    turn = between.cross(along).dot(cross) / size2 / radius;
    angle += turn;
  }
  if (std::abs(turn) > same_place / radius) return;
  for (const double sign : {1.0, -1.0}) {
    const Vector3d n = sign / std::sqrt(size2) * cross, n_A = view.n_A(n);
    const double gap = (start - p).dot(n);
    if (!(gap < view.reach && gap > -view.deepest)) continue;
    if (std::max(-s, s - 1.0) * along.norm() > beyond(gap)) continue;
    if (is_supporting(-out, Vector3d(0.0, 0.0, -std::copysign(1.0, height)), n) &&
        is_supporting(e.edge.into_left, e.edge.into_right, -n_A))
      view.add(p, n, gap);
  }
}

/// The same with both rims: from where the edge goes through the plane of a rim, and where it crosses the side.
void edge_and_rims(const View& view, const EdgeView& e) {
  const double radius = view.b.cylinder->radius;
  if (std::max(e.start.head<2>().norm(), e.end.head<2>().norm()) < radius - e.far) return;
  const double across = (e.start + e.middle * e.along).head<2>().norm();
  const double half = e.size > 0.0 ? std::sqrt(std::max(0.0, radius * radius - across * across) / e.size) : 0.0;
  for (const double height : {-0.5 * view.b.cylinder->length, 0.5 * view.b.cylinder->length}) {
    if (!e.is_near_height(height)) continue;
    const double through = e.along.z() != 0.0 ? (height - e.start.z()) / e.along.z() : e.middle;
    for (const double s : {through, e.middle - half, e.middle + half}) {
      const Vector3d q = e.start + std::clamp(s, 0.0, 1.0) * e.along;
      edge_and_rim(view, e, height, std::atan2(q.y(), q.x()));
    }
  }
}

void edges_and_edges(const View& view) {
  for (const auto& [a, b] : edges_near(view, view.b.edge_tree)) {
    edge_and_edge(view, view.a.edges[a], view.b.edges[b]);
  }
}

void edges_and_cylinder(const View& view) {
  if (!view.b.cylinder || view.a.cylinder) return;
  for (const Solid::Edge& edge : view.a.edges) {
    const EdgeView e(view, edge);
    if (!e.is_near(*view.b.cylinder)) continue;
    edge_and_side(view, e);
    edge_and_rims(view, e);
  }
}

/// Whether a line from `start` to `start + along` goes through a face.
bool crosses(const Vector3d& start, const Vector3d& along, const Solid::Face& face) {
  const double before = face.n.dot(start - face.corners[0]), after = before + face.n.dot(along);
  return before * after < 0.0 && over(face, start + before / (before - after) * along, 0.0);
}

/// The interval in which a straight line is inside a cylinder, as two multiples of `along`.
std::pair<double, double> inside(const Cylinder& c, const Vector3d& start, const Vector3d& along) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double from = -infinity, to = infinity;
  const auto cut = [&](double middle, double half) {
    from = std::max(from, middle - half);
    to = std::min(to, middle + half);
  };
  if (along.z() != 0.0) cut(-start.z() / along.z(), 0.5 * c.length / std::abs(along.z()));
  if (along.z() == 0.0 && std::abs(start.z()) > 0.5 * c.length) cut(0.0, -infinity);
  const Eigen::Vector2d p = start.head<2>(), d = along.head<2>();
  const double size = d.squaredNorm(), middle = size > 0.0 ? -p.dot(d) / size : 0.0;
  const double left = c.radius * c.radius - (p + middle * d).squaredNorm();
  if (left < 0.0) cut(0.0, -infinity);
  if (size > 0.0 && left >= 0.0) cut(middle, std::sqrt(left / size));
  return {from, to};
}

/// Whether an edge of `a`, or the axis of a cylinder, enters `b`, or a rim a face of a box. If two solids overlap, a
/// corner of the hull of their intersection is such a point or a corner of one of the solids.
bool pierces(const View& view) {
  const auto lowest_enters = [&view](const Solid::Face& face) {
    return contains(view.b.geometry, view.X_BA * furthest(view.a, -view.n_A(face.n)));
  };
  const bool on_box = view.a.cylinder && std::holds_alternative<Box>(view.b.geometry);
  if (on_box && std::any_of(view.b.faces.begin(), view.b.faces.end(), lowest_enters)) return true;
  for (const auto& [e, face] : edges_near(view, view.b.face_tree)) {
    const Solid::Edge& edge = view.a.edges[e];
    if (crosses(view.X_BA * edge.start, view.X_BA.linear() * edge.along, view.b.faces[face])) return true;
  }
  const auto enters = [&](const Vector3d& start, const Vector3d& along) {
    const Vector3d start_B = view.X_BA * start, along_B = view.X_BA.linear() * along;
    if (!view.b.cylinder) {
      return std::any_of(view.b.faces.begin(), view.b.faces.end(),
                         [&](const Solid::Face& face) { return crosses(start_B, along_B, face); });
    }
    const auto [from, to] = inside(*view.b.cylinder, start_B, along_B);
    return std::max(from, 0.0) < std::min(to, 1.0);
  };
  const double length = view.a.cylinder ? view.a.cylinder->length : 0.0;
  if (length > 0.0 && enters(-0.5 * length * Vector3d::UnitZ(), length * Vector3d::UnitZ())) return true;
  return view.b.cylinder && std::any_of(view.a.edges.begin(), view.a.edges.end(),
                                        [&](const Solid::Edge& edge) { return enters(edge.start, edge.along); });
}

/// Whether a point of `a` is contained in `b`; if neither pierces the other, it is as a whole.
bool is_contained(const View& view) {
  const Vector3d p = view.X_BA * furthest(view.a, Vector3d::UnitX());
  return view.b.extent.contains(p) && contains(view.b.geometry, p);
}

void append(const std::vector<BoxContact>& found, const RigidTransform& X, bool swap_bodies,
            std::vector<BoxContact>& contacts) {
  for (const BoxContact& c : found) {
    const Vector3d n = X.linear() * c.n_W;
    contacts.push_back(
        {X * Vector3d(swap_bodies ? c.p_W + c.gap * c.n_W : c.p_W), swap_bodies ? Vector3d(-n) : n, c.gap});
  }
}

}  // namespace

void PartTree::build() {
  if (boxes.empty()) return;
  std::vector<int> parts(boxes.size());
  std::iota(parts.begin(), parts.end(), 0);
  std::vector<Eigen::AlignedBox3d> around = boxes;
  if (parts.size() == 1) {  // Eigen's tree has no root for one
    parts.push_back(0);
    around.push_back(around[0]);
  }
  tree = std::make_unique<const Eigen::KdBVH<double, 3, int>>(parts.begin(), parts.end(), around.begin(), around.end());
}

std::vector<std::size_t> PartTree::inside(const Eigen::AlignedBox3d& box) const {
  struct Inside {
    const std::vector<Eigen::AlignedBox3d>& boxes;
    const Eigen::AlignedBox3d& box;
    std::vector<std::size_t> found;
    bool intersectVolume(const Eigen::AlignedBox3d& other) const { return box.intersects(other); }
    bool intersectObject(int part) {
      const auto i = static_cast<std::size_t>(part);
      if (box.intersects(boxes[i])) found.push_back(i);
      return false;
    }
  } inside{boxes, box, {}};
  if (tree) Eigen::BVIntersect(*tree, inside);
  return inside.found;
}

Solid::Solid(const Geometry& of) : geometry(of), extent(bounding_box(of)) {
  if (std::holds_alternative<Sphere>(of)) return;
  if (const auto* round = std::get_if<Cylinder>(&of)) cylinder = *round;
  const std::shared_ptr<const Surface> surface = make_surface(of);
  for (std::size_t i = 0; i < surface->normals.size(); ++i) {
    const int t = static_cast<int>(i);
    if (!(surface->normals[i].squaredNorm() > 0.0)) continue;  // degenerate
    const std::size_t before = edges.size();
    add_edges(*surface, t, edges);
    if (!cylinder) {
      faces.push_back({{surface->corner(t, 0), surface->corner(t, 1), surface->corner(t, 2)}, surface->normals[i]});
      continue;
    }
    const auto along_axis = [](const Edge& e) { return std::abs(e.along.z()) > 0.0; };
    edges.erase(std::remove_if(edges.begin() + static_cast<std::ptrdiff_t>(before), edges.end(), along_axis),
                edges.end());
  }
  for (const Edge& edge : edges) {
    edge_tree.boxes.emplace_back(edge.start).extend(Vector3d(edge.start + edge.along));
  }
  edge_tree.build();
  if (cylinder) return;
  for (const Face& face : faces) {
    face_tree.boxes.emplace_back(face.corners[0]).extend(face.corners[1]).extend(face.corners[2]);
  }
  face_tree.build();
  corners = surface->mesh->vertices;
  next.resize(corners.size());
  for (const Eigen::Vector3i& t : surface->mesh->triangles) {
    for (int k = 0; k < 3; ++k) next[static_cast<std::size_t>(t[k])].push_back(t[(k + 1) % 3]);
  }
}

Vector3d furthest(const Solid& solid, const Vector3d& along_S) {
  if (const auto* sphere = std::get_if<Sphere>(&solid.geometry)) return sphere->radius * along_S.normalized();
  if (!solid.cylinder) {
    return *std::max_element(solid.corners.begin(), solid.corners.end(),
                             [&](const Vector3d& a, const Vector3d& b) { return a.dot(along_S) < b.dot(along_S); });
  }
  const double size = along_S.head<2>().norm();
  Vector3d p(0.0, 0.0, std::copysign(0.5 * solid.cylinder->length, along_S.z()));
  if (size > 0.0) p.head<2>() = solid.cylinder->radius / size * along_S.head<2>();
  return p;
}

std::vector<Vector3d> lowest_points(const Solid& solid, const Vector3d& n_S) {
  if (std::holds_alternative<Sphere>(solid.geometry)) return {furthest(solid, -n_S)};
  const Vector3d u = n_S.unitOrthogonal();
  std::vector<Vector3d> points;
  for (int i = 0; i <= 8; ++i) {
    const double turn = 0.25 * M_PI * i;
    const Vector3d side = std::cos(turn) * u + std::sin(turn) * n_S.cross(u);
    points.push_back(furthest(solid, i < 8 ? Vector3d(slope_of_flush * side - n_S) : Vector3d(-n_S)));
  }
  return points;
}

std::vector<BoxContact> solid_contacts(const Solid& a, const RigidTransform& X_WA, const Solid& b,
                                       const RigidTransform& X_WB, double reach, double deepest) {
  const RigidTransform X_BA = X_WB.inverse() * X_WA, X_AB = X_BA.inverse();
  std::vector<BoxContact> contacts;
  if (const auto* sphere = std::get_if<Sphere>(&a.geometry)) {
    append(sphere_contacts(sphere->radius, X_BA.translation(), b, reach), X_WB, false, contacts);
    return contacts;
  }
  if (std::holds_alternative<Sphere>(b.geometry)) {
    append(solid_contacts(b, X_AB, a, RigidTransform::Identity(), reach, deepest), X_WA, true, contacts);
    return contacts;
  }
  std::vector<BoxContact> of_a, of_b;
  const View from_b{a, b, X_BA, reach, deepest, of_a}, from_a{b, a, X_AB, reach, deepest, of_b};
  points_and_faces(from_b);
  points_and_faces(from_a);
  if (a.cylinder.has_value() == b.cylinder.has_value()) edges_and_edges(from_b);
  edges_and_cylinder(from_b);
  edges_and_cylinder(from_a);
  append(of_a, X_WB, false, contacts);
  append(of_b, X_WA, true, contacts);
  return contacts;
}

bool overlap(const Solid& a, const RigidTransform& X_WA, const Solid& b, const RigidTransform& X_WB) {
  const auto is_sphere = [](const Solid& solid) { return std::holds_alternative<Sphere>(solid.geometry); };
  if (is_sphere(a) || is_sphere(b)) return !solid_contacts(a, X_WA, b, X_WB, 0.0, 0.0).empty();
  const RigidTransform X_BA = X_WB.inverse() * X_WA, X_AB = X_BA.inverse();
  std::vector<BoxContact> none;
  const View from_b{a, b, X_BA, 0.0, 0.0, none}, from_a{b, a, X_AB, 0.0, 0.0, none};
  return pierces(from_b) || pierces(from_a) || is_contained(from_b) || is_contained(from_a);
}

std::optional<BoxContact> exit_contact(const Solid& solid, const Vector3d& p_S, const Vector3d& n_S, double depth,
                                       double within) {
  std::optional<BoxContact> found;
  const auto offer = [&](double distance, const Vector3d& n) {
    if (!(std::abs(distance - depth) <= within)) return;
    within = std::abs(distance - depth);
    const double gap = -distance * n.dot(n_S);
    found = BoxContact{p_S - gap * n, n, gap};
  };
  for (const Solid::Face& face : solid.faces) {
    const double slope = face.n.dot(n_S);
    if (!(slope > 0.0)) continue;
    const double distance = face.n.dot(face.corners[0] - p_S) / slope;
    if (over(face, p_S + distance * n_S, same_place)) offer(distance, face.n);
  }
  if (solid.cylinder) {
    const double distance = inside(*solid.cylinder, p_S, n_S).second;
    const Vector3d out = p_S + distance * n_S;
    const bool of_end = std::abs(std::abs(out.z()) - 0.5 * solid.cylinder->length) < same_place;
    offer(distance,
          of_end ? Vector3d(0.0, 0.0, std::copysign(1.0, out.z())) : Vector3d(out.x(), out.y(), 0.0).normalized());
  }
  return found;
}

}  // namespace spring_workbench::geometry
