#include "benchmark/contact/pair_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "spring_workbench/geometry/box_gap.h"
#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::benchmark {
namespace {

constexpr int lines_around = 720;  // lines on a cylinder; the rim is outside of them by 4e-6 of the radius
constexpr double infinity = std::numeric_limits<double>::infinity();

double distance_to_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto to_segment = [&](const Vector3d& s, const Vector3d& e) {
    const Vector3d d = e - s;
    const double u = d.squaredNorm() > 0.0 ? std::clamp((p - s).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
    return (s + u * d - p).norm();
  };
  const Vector3d n = (b - a).cross(c - a);
  const auto left_of = [&](const Vector3d& s, const Vector3d& e) { return n.dot((e - s).cross(p - s)) >= 0.0; };
  if (n.squaredNorm() > 0.0 && left_of(a, b) && left_of(b, c) && left_of(c, a))
    return std::abs(n.dot(p - a)) / n.norm();
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

double distance_to_surface(const geometry::TriangleMesh& mesh, const Vector3d& p) {
  double least = infinity;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    least = std::min(least, distance_to_triangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
  }
  return least;
}

/// Depth of `p` below the surface, negative outside. Inside a convex shape it is a concave function of `p`.
double depth_at(const geometry::Geometry& geometry, const Vector3d& p) {
  const auto of = [](double x, double y) {  // depth below two perpendicular faces
    return x >= 0.0 || y >= 0.0 ? std::min(x, y) : -std::hypot(x, y);
  };
  if (const auto* box = std::get_if<geometry::Box>(&geometry)) {
    const Vector3d below = 0.5 * box->size - p.cwiseAbs();
    return below.minCoeff() >= 0.0 ? below.minCoeff() : -below.cwiseMin(0.0).norm();
  }
  if (const auto* sphere = std::get_if<geometry::Sphere>(&geometry)) return sphere->radius - p.norm();
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&geometry)) {
    return of(cylinder->radius - p.head<2>().norm(), 0.5 * cylinder->length - std::abs(p.z()));
  }
  const double distance = distance_to_surface(*std::get<geometry::MeshPtr>(geometry), p);
  return geometry::contains(geometry, p) ? distance : -distance;
}

/// Maximum of a unimodal function in an interval (golden-section search).
template <typename Function>
double largest(double from, double to, const Function& f) {
  const double share = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = to - share * (to - from), b = from + share * (to - from), fa = f(a), fb = f(b);
  double most = std::max({f(from), f(to), fa, fb});
  for (int i = 0; i < 40; ++i) {
    if (fa < fb) {
      from = a, a = b, fa = fb;
      b = from + share * (to - from), fb = f(b);
    } else {
      to = b, b = a, fb = fa;
      a = to - share * (to - from), fa = f(a);
    }
    most = std::max({most, fa, fb});
  }
  return most;
}

/// Crossings of a segment with a mesh: the fraction along the segment, and whether it enters the mesh there.
std::vector<std::pair<double, bool>> crossings(const geometry::TriangleMesh& mesh, const std::vector<std::size_t>& near,
                                               const Vector3d& p, const Vector3d& q) {
  std::vector<std::pair<double, bool>> found;
  const Vector3d d = q - p, low = p.cwiseMin(q), high = p.cwiseMax(q);
  for (const std::size_t i : near) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    const Vector3d &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    if ((a.cwiseMax(b).cwiseMax(c) - low).minCoeff() < 0.0 || (high - a.cwiseMin(b).cwiseMin(c)).minCoeff() < 0.0)
      continue;
    const Vector3d e1 = b - a, e2 = c - a, h = d.cross(e2);
    const double det = e1.dot(h);
    if (det == 0.0) continue;
    const Vector3d s = p - a, r = s.cross(e1);
    const double u = s.dot(h) / det, v = d.dot(r) / det, at = e2.dot(r) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || at < 0.0 || at > 1.0) continue;
    found.emplace_back(at, det > 0.0);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The deepest point of edges below the surface of a mesh.
class InMesh {
 public:
  using Edge = std::pair<std::size_t, std::size_t>;
  InMesh(const geometry::TriangleMesh& mesh, const std::vector<Vector3d>& points, const Eigen::AlignedBox3d& box)
      : mesh_(mesh), points_(points), inside_(points.size(), false) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Eigen::AlignedBox3d of(mesh.corner(mesh.triangles[i], 0));
      of.extend(mesh.corner(mesh.triangles[i], 1)).extend(mesh.corner(mesh.triangles[i], 2));
      if (of.intersects(box)) near_.push_back(i);
    }
  }

  double depth_of(const std::vector<Edge>& edges) {
    std::vector<Edge> whole;
    for (const Edge& edge : edges) {
      if (!look_at(edge)) whole.push_back(edge);
    }
    for (bool more = any_; more;) {  // points connected to an inside point are inside
      more = false;
      for (const auto& [i, j] : whole) {
        if (inside_[i] == inside_[j]) continue;
        // As in look_at: it goes out where it crosses at a seam.
        if (!geometry::contains(own(), points_[inside_[i] ? j : i])) continue;
        more = inside_[i] = inside_[j] = true;
        look_between(points_[i], points_[j], 0.0, 1.0);
      }
    }
    if (!any_ && !points_.empty() && geometry::contains(own(), points_[0])) {
      for (const Vector3d& p : points_) depth_ = std::max(depth_, distance_to_surface(mesh_, p));
    }
    return depth_;
  }

 private:
  geometry::Geometry own() const { return geometry::MeshPtr(geometry::MeshPtr(), &mesh_); }

  /// Returns false for an edge that does not cross the surface.
  bool look_at(const Edge& edge) {
    const Vector3d &p = points_[edge.first], &q = points_[edge.second];
    const auto crossed = crossings(mesh_, near_, p, q);
    if (crossed.empty()) return false;
    any_ = true;
    double in_since = 0.0;
    // A crossing of an edge that lies along a face may be missed at a seam, so the winding number decides.
    bool inside = !crossed.front().second && geometry::contains(own(), p);
    inside_[edge.first] = inside_[edge.first] || inside;
    for (const auto& [at, goes_in] : crossed) {
      if (inside && !goes_in) look_between(p, q, in_since, at);
      inside = goes_in;
      in_since = at;
    }
    inside = inside && geometry::contains(own(), q);
    if (inside) look_between(p, q, in_since, 1.0);
    inside_[edge.second] = inside_[edge.second] || inside;
    return true;
  }
  void look_between(const Vector3d& p, const Vector3d& q, double from, double to) {
    depth_ = std::max(depth_, largest(from, to, [&](double u) { return distance_to_surface(mesh_, p + u * (q - p)); }));
  }

  const geometry::TriangleMesh& mesh_;
  const std::vector<Vector3d>& points_;
  std::vector<std::size_t> near_;
  std::vector<bool> inside_;
  double depth_ = 0.0;
  bool any_ = false;
};

}  // namespace

PairDepth::PairDepth(const scene::Scene& scene) : scene_(scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (const geometry::Shape& shape : scene.bodies[i].collision) solids_.push_back(solid_of(i, shape));
  }
}

PairDepth::Solid PairDepth::solid_of(std::size_t body, const geometry::Shape& shape) {
  Solid solid{body, &shape, {}, {}};
  if (const auto* box = std::get_if<geometry::Box>(&shape.geometry)) {
    for (const Vector3d& corner : geometry::corners(0.5 * box->size)) solid.points.push_back(corner);
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool edge = ((solid.points[i] - solid.points[j]).array().abs() > 0.0).count() == 1;
        if (edge) solid.edges.emplace_back(i, j);
      }
    }
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape.geometry)) {
    for (std::size_t i = 0; i < lines_around; ++i) {
      const double a = 2.0 * M_PI * static_cast<double>(i) / lines_around, r = cylinder->radius;
      const std::size_t next = (i + 1) % lines_around;
      for (const double side : {-0.5, 0.5}) {
        solid.points.emplace_back(r * std::cos(a), r * std::sin(a), side * cylinder->length);
      }
      solid.edges.emplace_back(2 * i, 2 * i + 1);
      solid.edges.emplace_back(2 * i, 2 * next);
      solid.edges.emplace_back(2 * i + 1, 2 * next + 1);
    }
  } else if (const auto* mesh = std::get_if<geometry::MeshPtr>(&shape.geometry)) {
    solid.points = (*mesh)->vertices;
    std::set<std::pair<std::size_t, std::size_t>> edges;
    for (const Eigen::Vector3i& t : (*mesh)->triangles) {
      for (int k = 0; k < 3; ++k) {
        const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
        edges.insert(std::minmax(a, b));
      }
    }
    solid.edges.assign(edges.begin(), edges.end());
  }
  return solid;
}

double PairDepth::depth_below(const Placed& of, double height) {
  const geometry::Geometry& geometry = of.solid->shape->geometry;
  if (const auto* sphere = std::get_if<geometry::Sphere>(&geometry)) {
    return height - of.X_WS.translation().z() + sphere->radius;
  }
  double lowest = infinity;
  for (const Vector3d& p : of.solid->points) lowest = std::min(lowest, (of.X_WS * p).z());
  return height - lowest;
}

double PairDepth::depth_of_edges(const Placed& of, const Placed& in) {
  const RigidTransform X = in.X_WS.inverse() * of.X_WS;
  const geometry::Geometry& geometry = in.solid->shape->geometry;
  const Eigen::AlignedBox3d around = geometry::bounding_box(geometry);
  std::vector<Vector3d> points;
  points.reserve(of.solid->points.size());
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : of.solid->points) box.extend(points.emplace_back(X * p));
  if (!box.intersects(around)) return 0.0;
  if (const auto* mesh = std::get_if<geometry::MeshPtr>(&geometry)) {
    return InMesh(**mesh, points, box).depth_of(of.solid->edges);
  }
  double depth = 0.0;
  for (const auto& [i, j] : of.solid->edges) {
    const Vector3d &p = points[i], &q = points[j];
    if ((p.cwiseMax(q) - around.min()).minCoeff() < 0.0 || (around.max() - p.cwiseMin(q)).minCoeff() < 0.0) continue;
    depth = std::max(depth, largest(0.0, 1.0, [&](double u) { return depth_at(geometry, p + u * (q - p)); }));
  }
  return depth;
}

double PairDepth::depth_between(const Placed& a, const Placed& b) {
  const geometry::Geometry &of_a = a.solid->shape->geometry, &of_b = b.solid->shape->geometry;
  const auto *box_a = std::get_if<geometry::Box>(&of_a), *box_b = std::get_if<geometry::Box>(&of_b);
  if (box_a != nullptr && box_b != nullptr) {
    return -geometry::gap_between({a.X_WS, 0.5 * box_a->size, true}, {b.X_WS, 0.5 * box_b->size, true}).gap;
  }
  if (const auto* sphere = std::get_if<geometry::Sphere>(&of_a)) {
    return sphere->radius + depth_at(of_b, b.X_WS.inverse() * a.X_WS.translation());
  }
  if (std::holds_alternative<geometry::Sphere>(of_b)) return depth_between(b, a);
  return std::max(depth_of_edges(a, b), depth_of_edges(b, a));
}

DeepestPair PairDepth::deepest(const std::vector<RigidTransform>& X_WO) const {
  std::vector<Placed> placed;
  for (const Solid& solid : solids_) {
    Placed p{&solid, X_WO[solid.body] * solid.shape->X_OS, {}};
    p.box_W = geometry::bounding_box(solid.shape->geometry, p.X_WS);
    placed.push_back(p);
  }
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return a.box_W.min().x() < b.box_W.min().x(); });
  DeepestPair deepest;
  const auto take = [&](double depth, std::size_t body, const std::string& other) {
    if (depth > deepest.depth) deepest = {depth, scene_.bodies[body].name, other};
  };
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Placed& a = placed[i];
    const scene::Body& body = scene_.bodies[a.solid->body];
    if (body.movable && a.box_W.min().z() < scene_.bench_height) {
      take(depth_below(a, scene_.bench_height), a.solid->body, "workbench");
    }
    for (std::size_t j = i + 1; j < placed.size() && placed[j].box_W.min().x() <= a.box_W.max().x(); ++j) {
      const Placed& b = placed[j];
      const scene::Body& other = scene_.bodies[b.solid->body];
      if (a.solid->body == b.solid->body || !(body.movable || other.movable) || !a.box_W.intersects(b.box_W)) continue;
      take(depth_between(a, b), a.solid->body, other.name);
    }
  }
  return deepest;
}

}  // namespace spring_workbench::benchmark
