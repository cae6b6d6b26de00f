#include "spring_workbench/ros_interface/markers.h"

#include <algorithm>

#include "spring_workbench/ros_interface/conversions.h"
#include "spring_workbench/ros_interface/tube_mesh.h"

namespace spring_workbench {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;
using Color = Eigen::Vector4d;

const Color fork_color(0.75, 0.77, 0.80, 1.0);
const Color handle_color(0.20, 0.22, 0.26, 1.0);
const Color contact_color(1.0, 0.25, 0.05, 1.0);
const Color force_color(0.10, 0.85, 0.95, 1.0);
const Color gap_color(1.0, 0.3, 0.8, 1.0);
const Color highlight_color(1.0, 1.0, 0.55, 1.0);

std_msgs::ColorRGBA to_color(const Color& color) {
  std_msgs::ColorRGBA message;
  message.r = static_cast<float>(color[0]);
  message.g = static_cast<float>(color[1]);
  message.b = static_cast<float>(color[2]);
  message.a = static_cast<float>(color[3]);
  return message;
}

/// Makes the markers of one moment.
class Drawing {
 public:
  Drawing(const Simulation& simulation, const std_msgs::Header& header)
      : simulation_(simulation), scene_(simulation.scene()), tool_(simulation.fork()), header_(header) {}

  MarkerArray markers() {
    draw_bodies();
    draw_targets();
    draw_fork();
    draw_contacts();
    return std::move(markers_);
  }

 private:
  Marker& add(const std::string& ns, int id, int type, const RigidTransform& X_W, const Color& color) {
    Marker marker;
    marker.header = header_;
    marker.ns = ns;
    marker.id = id;
    marker.type = type;
    marker.action = Marker::ADD;
    marker.pose = to_pose(X_W);
    marker.color = to_color(color);
    marker.scale = to_vector(Vector3d::Ones());
    markers_.markers.push_back(marker);
    return markers_.markers.back();
  }

  void draw_shape(const std::string& ns, int id, const Shape& shape, const RigidTransform& X_WO, const Color& color) {
    Marker& marker = add(ns, id, Marker::CUBE, X_WO * shape.X_OS, color);
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      marker.scale = to_vector(box->size);
    } else if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      marker.type = Marker::SPHERE;
      marker.scale = to_vector(Vector3d::Constant(2.0 * sphere->radius));
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
      marker.type = Marker::CYLINDER;
      marker.scale = to_vector(Vector3d(2.0 * cylinder->radius, 2.0 * cylinder->radius, cylinder->length));
    } else {
      fill_mesh(*std::get<MeshPtr>(shape.geometry), marker);
    }
  }

  static void fill_mesh(const TriangleMesh& mesh, Marker& marker) {
    marker.type = Marker::TRIANGLE_LIST;
    for (const Eigen::Vector3i& triangle : mesh.triangles) {
      for (const int corner : triangle)
        marker.points.push_back(to_point(mesh.vertices[static_cast<std::size_t>(corner)]));
    }
  }

  void draw_body(const Body& body, const RigidTransform& X_WO, bool highlighted) {
    int id = 0;
    for (const Shape& shape : body.visual) {
      Color color = shape.color;
      if (highlighted) color.head<3>() = 0.35 * color.head<3>() + 0.65 * highlight_color.head<3>();
      draw_shape(body.name, id++, shape, X_WO, color);
    }
  }

  void draw_bodies() {
    for (const Body& body : scene_.bodies) {
      if (!body.movable) draw_body(body, body.X_WO, false);
    }
    for (const BodyState& object : simulation_.objects()) {
      draw_body(scene_.bodies[*find_body(scene_, object.name)], object.X_WO, object.highlighted);
    }
  }

  void draw_targets() {
    constexpr double opacity = 0.25;
    for (const auto& [name, target] : scene_.targets) {
      const Body& body = scene_.bodies[*find_body(scene_, name)];
      int id = 0;
      for (const Shape& shape : body.visual) {
        Color color = shape.color;
        color[3] *= opacity;
        draw_shape("target " + name, id++, shape, target.X_WL * body.X_OL.inverse(), color);
      }
    }
  }

  void draw_fork() {
    constexpr int centreline_points = 65;
    constexpr double thickness = 0.12, body = 0.55;  // of the handle, in parts of the fork's length
    const double L = tool_.length;
    Marker& fork = add("fork", 0, Marker::TRIANGLE_LIST, RigidTransform::Identity(), fork_color);
    for (const Vector3d& p : fork_mesh(simulation_.centreline(centreline_points), L, ForkLook())) {
      fork.points.push_back(to_point(p));
    }
    RigidTransform X_WG = tool_.X_WH_seen;
    X_WG.translate(Vector3d(0.0, 0.0, -0.5 * body * L));
    add("fork", 1, Marker::CYLINDER, X_WG, handle_color).scale = to_vector(L * Vector3d(thickness, thickness, body));
    draw_gap();
    draw_force();
  }

  void draw_gap() {
    constexpr double smallest = 1e-5;  // [m]
    if ((tool_.X_WH.translation() - tool_.X_WH_seen.translation()).norm() < smallest) return;
    Marker& line = add("fork", 2, Marker::LINE_LIST, RigidTransform::Identity(), gap_color);
    line.scale.x = 0.01 * tool_.length;
    line.points = {to_point(tool_.X_WH.translation()), to_point(tool_.X_WH_seen.translation())};
  }

  void draw_force() {
    const auto held = find_body(scene_, tool_.held_object);
    if (!held) return;
    const double weight = scene_.bodies[*held].mass_properties.mass * std::max(scene_.gravity, 1.0);
    const Vector3d arrow = 0.5 * tool_.length * tool_.tip_wrench_W.force / weight;
    constexpr double shortest = 1e-3, longest = 1.0;  // [m]
    if (!(weight > 0.0) || !(arrow.norm() > shortest)) return;
    const Vector3d begin = tool_.X_WE.translation();
    const Vector3d end = begin + arrow * std::min(1.0, longest / arrow.norm());
    draw_arrow("force", 0, begin, end, 0.03 * tool_.length, force_color);
  }

  void draw_arrow(const std::string& ns, int id, const Vector3d& begin, const Vector3d& end, double thickness,
                  const Color& color) {
    Marker& arrow = add(ns, id, Marker::ARROW, RigidTransform::Identity(), color);
    arrow.points = {to_point(begin), to_point(end)};
    arrow.scale = to_vector(thickness * Vector3d(1.0, 2.2, 3.0));
  }

  void draw_contacts() {
    const double size = 0.05 * tool_.length;
    int id = 0;
    for (const ContactState& contact : simulation_.contacts()) {
      if (contact.phase == ContactPhase::ended) continue;
      RigidTransform X_WC = RigidTransform::Identity();
      X_WC.translation() = contact.p_W;
      add("contact points", id, Marker::SPHERE, X_WC, contact_color).scale = to_vector(Vector3d::Constant(size));
      draw_arrow("contact normals", id++, contact.p_W, contact.p_W + 4.0 * size * contact.n_W, 0.3 * size,
                 contact_color);
    }
  }

  const Simulation& simulation_;
  const Scene& scene_;
  const ToolState tool_;
  const std_msgs::Header header_;
  MarkerArray markers_;
};

}  // namespace

MarkerArray MarkerBuilder::build(const Simulation& simulation, const std_msgs::Header& header) {
  MarkerArray markers = Drawing(simulation, header).markers();
  delete_what_is_gone(header, markers);
  return markers;
}

void MarkerBuilder::delete_what_is_gone(const std_msgs::Header& header, MarkerArray& markers) {
  std::set<MarkerKey> now;
  for (const Marker& marker : markers.markers) now.emplace(marker.ns, marker.id);
  for (const MarkerKey& key : shown_) {
    if (now.count(key) != 0) continue;
    Marker marker;
    marker.header = header;
    marker.ns = key.first;
    marker.id = key.second;
    marker.action = Marker::DELETE;
    markers.markers.push_back(marker);
  }
  shown_ = std::move(now);
}

}  // namespace spring_workbench
