#include "scene_markers.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "file_colors.h"
#include "spring_workbench/fork_mesh/constants.h"
#include "spring_workbench/fork_mesh/load_color.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/ros/common/conversions.h"

namespace spring_workbench::markers {
namespace {

using visualization_msgs::Marker;

const Color contact_color(1.0, 0.25, 0.05, 1.0);
const Color shadow_color(0.0, 0.0, 0.0, 0.45);

/// A mesh by its file where it has one: rviz reads it once, and a message is small.
void set_mesh(const geometry::TriangleMesh& mesh, Marker& marker) {
  if (!mesh.uri.empty()) {
    marker.type = Marker::MESH_RESOURCE;
    marker.mesh_resource = mesh.uri;
    marker.scale = ros_common::to_vector(mesh.scale);
    return;
  }
  marker.type = Marker::TRIANGLE_LIST;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (const int corner : triangle)
      marker.points.push_back(ros_common::to_point(mesh.vertices[static_cast<std::size_t>(corner)]));
  }
}

void draw_shape(const std::string& ns, int id, const geometry::Shape& shape, const RigidTransform& X_WO,
                const Color& color, MarkerList& markers) {
  Marker& marker = markers.add(ns, id, Marker::CUBE, X_WO * shape.X_OS, color);
  if (const auto* box = std::get_if<geometry::Box>(&shape.geometry)) {
    marker.scale = ros_common::to_vector(box->size);
  } else if (const auto* sphere = std::get_if<geometry::Sphere>(&shape.geometry)) {
    marker.type = Marker::SPHERE;
    marker.scale = ros_common::to_vector(Vector3d::Constant(2.0 * sphere->radius));
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape.geometry)) {
    marker.type = Marker::CYLINDER;
    marker.scale = ros_common::to_vector(Vector3d(2.0 * cylinder->radius, 2.0 * cylinder->radius, cylinder->length));
  } else {
    set_mesh(*std::get<geometry::MeshPtr>(shape.geometry), marker);
    if (color != shape.color || !has_file_colors(shape)) return;  // lit or translucent: in one colour
    marker.mesh_use_embedded_materials = 1;
    marker.color = std_msgs::ColorRGBA();  // no tint
  }
}

void draw_body(const scene::Body& body, const RigidTransform& X_WO, bool highlighted, bool pierced,
               MarkerList& markers) {
  int id = 0;
  for (const geometry::Shape& shape : body.visual) {
    Color color = shape.color;
    if (highlighted) color.head<3>() = fork_mesh::highlighted(color.head<3>());
    if (pierced) color[3] *= fork_mesh::pierced_opacity;
    draw_shape(body.name, id++, shape, X_WO, color, markers);
  }
}

/// Points of a shape's surface, in W, whose shadow is the shape's; of a mesh, its box.
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
    points_W.push_back(X_WS.translation() - Vector3d(0.0, 0.0, sphere->radius));  // says how high it is
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape.geometry)) {
    add_circle(cylinder->radius, -0.5 * cylinder->length, X_WS);
    add_circle(cylinder->radius, 0.5 * cylinder->length, X_WS);
  } else {
    const Eigen::AlignedBox3d box = geometry::bounding_box(shape.geometry);
    for (int i = 0; i < 8; ++i) points_W.push_back(X_WS * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  }
}

/// Convex hull of the points seen from above, counter-clockwise (Andrew's monotone chain).
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
    hull.pop_back();  // the other pass begins with it
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

void draw_shadow(int id, const std::vector<Vector3d>& points_W, double bench_height, MarkerList& markers) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : points_W) lowest = std::min(lowest, p.z());
  if (!std::isfinite(lowest) || lowest < bench_height + least_shadow_height) return;
  const std::vector<Vector3d> hull = hull_from_above(points_W, bench_height + shadow_above_bench);
  std::vector<Vector3d> corners;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) corners.insert(corners.end(), {hull[0], hull[i], hull[i + 1]});
  if (!corners.empty()) markers.add_points("shadow", id, Marker::TRIANGLE_LIST, corners, shadow_color);
}

}  // namespace

void draw_bodies(const live::View& view, MarkerList& markers) {
  const scene::Scene& scene = *view.scene;
  for (const scene::Body& body : scene.bodies) {
    if (!body.movable) draw_body(body, body.X_WO, false, false, markers);
  }
  view.for_each_object([&](const bodies::BodyState& object, const scene::Body& body) {
    draw_body(body, object.X_WO, object.highlighted, object.highlighted || object.held, markers);
  });
}

void draw_targets(const scene::Scene& scene, MarkerList& markers) {
  for (const auto& [name, target] : scene.targets) {
    const scene::Body& body = scene.bodies[*scene::find_body(scene, name)];
    int id = 0;
    for (const geometry::Shape& shape : body.visual) {
      Color color = shape.color;
      color[3] *= target_opacity;
      draw_shape("target " + name, id++, shape, target.X_WL * body.X_OL.inverse(), color, markers);
    }
  }
}

void draw_shadows(const live::View& view, const std::vector<std::vector<Vector3d>>& forks_W, MarkerList& markers) {
  const scene::Scene& scene = *view.scene;
  int id = 0;
  view.for_each_object([&](const bodies::BodyState& object, const scene::Body& body) {
    std::vector<Vector3d> outline;
    for (const geometry::Shape& shape : body.visual) add_outline(shape, object.X_WO, outline);
    draw_shadow(id++, outline, scene.bench_height, markers);
  });
  for (const std::vector<Vector3d>& fork_W : forks_W) draw_shadow(id++, fork_W, scene.bench_height, markers);
}

void draw_contacts(const std::vector<contact::ContactState>& contacts, double fork_length, MarkerList& markers) {
  const double size = 0.05 * fork_length;
  int id = 0;
  for (const contact::ContactState& contact : contacts) {
    if (contact.phase == contact::ContactPhase::ended) continue;
    RigidTransform X_WC = RigidTransform::Identity();
    X_WC.translation() = contact.p_W;
    markers.add_shape("contact points", id, Marker::SPHERE, X_WC, Vector3d::Constant(size), contact_color);
    markers.add_arrow("contact normals", id++, contact.p_W, contact.p_W + 4.0 * size * contact.n_W, 0.3 * size,
                      contact_color);
  }
}

}  // namespace spring_workbench::markers
