#include "shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "constants.h"
#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::markers {
namespace {

const Color shadow_color(0.0, 0.0, 0.0, 0.45);

/// Adds points of a shape's surface, in W, whose shadow is that of the shape; for a mesh, those of its bounding box.
void add_outline(const geometry::Shape& shape, const RigidTransform& X_WO, std::vector<Vector3d>& points_W) {
  const RigidTransform X_WS = X_WO * shape.X_OS;
  const auto add_circle = [&](double radius, double z, const RigidTransform& X) {
    for (int i = 0; i < outline_sides; ++i) {
      const double angle = 2.0 * M_PI * i / outline_sides;
      points_W.push_back(X * Vector3d(radius * std::cos(angle), radius * std::sin(angle), z));
    }
  };
  if (const auto* sphere = std::get_if<geometry::Sphere>(&shape.geometry)) {
    RigidTransform X_W = RigidTransform::Identity();
    X_W.translation() = X_WS.translation();
    add_circle(sphere->radius, 0.0, X_W);
    points_W.push_back(X_WS.translation() - Vector3d(0.0, 0.0, sphere->radius));  // the lowest point, for the height
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape.geometry)) {
    add_circle(cylinder->radius, -0.5 * cylinder->length, X_WS);
    add_circle(cylinder->radius, 0.5 * cylinder->length, X_WS);
  } else {
    const Eigen::AlignedBox3d box = geometry::bounding_box(shape.geometry);
    for (int i = 0; i < 8; ++i) points_W.push_back(X_WS * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  }
}

/// Convex hull of the points in plan view, counter-clockwise (Andrew's monotone chain).
std::vector<Vector3d> hull_from_above(std::vector<Vector3d> points, double z) {
  for (Vector3d& p : points) p.z() = z;
  std::sort(points.begin(), points.end(),
            [](const Vector3d& a, const Vector3d& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vector3d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = hull.size();
    for (const Vector3d& p : points) {
      while (hull.size() >= first + 2 && (hull.back() - hull[hull.size() - 2]).cross(p - hull.back()).z() <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();  // it is the first point of the other pass
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// The shadow as triangles; empty for an object on the bench.
std::vector<Vector3d> corners_of(const std::vector<Vector3d>& points_W, double bench_height) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : points_W) lowest = std::min(lowest, p.z());
  if (!std::isfinite(lowest) || lowest < bench_height + min_shadow_height) return {};
  const std::vector<Vector3d> hull = hull_from_above(points_W, bench_height + shadow_above_bench);
  std::vector<Vector3d> corners;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) corners.insert(corners.end(), {hull[0], hull[i], hull[i + 1]});
  return corners;
}

void draw_shadow(int id, const std::vector<Vector3d>& corners, MarkerList& markers) {
  if (!corners.empty())
    markers.add_points("shadow", id, visualization_msgs::Marker::TRIANGLE_LIST, corners, shadow_color);
}

}  // namespace

void Shadows::follow(const live::View& view) {
  if (bodies_.empty())
    view.for_each_object([this](const bodies::BodyState&, const scene::Body& body) { bodies_.push_back(&body); });
  const live::SharedStates::Parts& parts = view.objects.parts();
  std::vector<Vector3d> outline;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (view.objects.shares(part, drawn_)) continue;
    std::size_t i = live::SharedStates::begin_of(part);
    for (const bodies::BodyState& object : *parts[part]) {
      outline.clear();
      for (const geometry::Shape& shape : bodies_[i]->visual) add_outline(shape, object.X_WO, outline);
      std::vector<Vector3d> corners = corners_of(outline, view.scene->bench_height);
      corners_.erase(i);
      if (!corners.empty()) corners_.emplace(i, std::move(corners));
      ++i;
    }
  }
  drawn_ = view.objects;
}

void Shadows::draw(const live::View& view, const std::vector<std::vector<Vector3d>>& forks_W, MarkerList& markers) {
  follow(view);
  for (const auto& [object, corners] : corners_) draw_shadow(static_cast<int>(object), corners, markers);
  int id = static_cast<int>(bodies_.size());
  for (const std::vector<Vector3d>& fork_W : forks_W)
    draw_shadow(id++, corners_of(fork_W, view.scene->bench_height), markers);
}

}  // namespace spring_workbench::markers
