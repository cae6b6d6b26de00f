#include "scene_markers.h"

#include "constants.h"
#include "file_colors.h"
#include "spring_workbench/fork_mesh/constants.h"
#include "spring_workbench/fork_mesh/load_color.h"
#include "spring_workbench/ros/common/conversions.h"

namespace spring_workbench::markers {
namespace {

using visualization_msgs::Marker;

const Color contact_color(1.0, 0.25, 0.05, 1.0);

/// Sets a mesh by its file, if it has one: rviz reads the file once, and the message stays small.
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
    if (color != shape.color || !has_file_colors(shape)) return;  // highlighted or translucent: in a single colour
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
