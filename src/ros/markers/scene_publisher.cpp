#include "spring_workbench/ros/markers/scene_publisher.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "file_colors.h"
#include "marker_list.h"
#include "spring_workbench/ros/common/conversions.h"

namespace spring_workbench::markers {
namespace {

using MeshIndices = std::map<geometry::MeshPtr, std::uint32_t>;

MeshDescription to_message(const geometry::TriangleMesh& mesh) {
  MeshDescription message;
  message.uri = mesh.uri;
  message.vertices.reserve(3 * mesh.vertices.size());
  for (const Vector3d& v : mesh.vertices) {
    for (const double x : v) message.vertices.push_back(static_cast<float>(x));
  }
  message.triangles.reserve(3 * mesh.triangles.size());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (const int corner : t) message.triangles.push_back(static_cast<std::uint32_t>(corner));
  }
  return message;
}

ShapeDescription to_message(const geometry::Shape& shape, MeshIndices& meshes, SceneDescription& scene) {
  ShapeDescription message;
  message.pose = ros_common::to_pose(shape.X_OS);
  message.color = to_color(shape.color);
  if (const auto* box = std::get_if<geometry::Box>(&shape.geometry)) {
    message.type = ShapeDescription::BOX;
    message.size = ros_common::to_vector(box->size);
  } else if (const auto* sphere = std::get_if<geometry::Sphere>(&shape.geometry)) {
    message.type = ShapeDescription::SPHERE;
    message.size = ros_common::to_vector(Vector3d::Constant(2.0 * sphere->radius));
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape.geometry)) {
    message.type = ShapeDescription::CYLINDER;
    message.size = ros_common::to_vector(Vector3d(2.0 * cylinder->radius, 2.0 * cylinder->radius, cylinder->length));
  } else {
    const auto& mesh = std::get<geometry::MeshPtr>(shape.geometry);
    message.type = ShapeDescription::MESH;
    const auto [entry, is_new] = meshes.emplace(mesh, static_cast<std::uint32_t>(scene.meshes.size()));
    if (is_new) scene.meshes.push_back(to_message(*mesh));
    message.mesh = entry->second;
    message.size = ros_common::to_vector(mesh->scale);
    message.file_colors = has_file_colors(shape) ? 1 : 0;
  }
  return message;
}

BodyDescription to_message(const scene::Body& body, MeshIndices& meshes, SceneDescription& scene) {
  BodyDescription message;
  message.name = body.name;
  message.movable = body.movable ? 1 : 0;
  message.mass = body.mass_properties.mass;
  for (int i = 0; i < 9; ++i)
    message.inertia[static_cast<std::size_t>(i)] = body.mass_properties.inertia_O(i / 3, i % 3);
  message.friction = body.material.friction;
  message.compliance = 1.0 / body.material.stiffness;
  message.pose = ros_common::to_pose(body.X_WO);
  message.link = ros_common::to_pose(body.X_OL);
  for (const geometry::Shape& shape : body.visual) message.visual.push_back(to_message(shape, meshes, scene));
  for (const geometry::Shape& shape : body.collision) message.collision.push_back(to_message(shape, meshes, scene));
  return message;
}

bool same_geometry(const geometry::Geometry& a, const geometry::Geometry& b) {
  if (a.index() != b.index()) return false;
  if (const auto* box = std::get_if<geometry::Box>(&a)) return box->size == std::get<geometry::Box>(b).size;
  if (const auto* sphere = std::get_if<geometry::Sphere>(&a))
    return sphere->radius == std::get<geometry::Sphere>(b).radius;
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&a)) {
    const auto& other = std::get<geometry::Cylinder>(b);
    return cylinder->radius == other.radius && cylinder->length == other.length;
  }
  return std::get<geometry::MeshPtr>(a) == std::get<geometry::MeshPtr>(b);
}

bool same_shapes(const std::vector<geometry::Shape>& a, const std::vector<geometry::Shape>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return same_geometry(x.geometry, y.geometry) && x.X_OS.matrix() == y.X_OS.matrix() && x.color == y.color;
  });
}

bool same_body(const scene::Body& a, const scene::Body& b) {
  const auto values = [](const scene::Body& body) {
    return std::tie(body.name, body.movable, body.mass_properties.mass, body.material.friction);
  };
  return values(a) == values(b) && a.mass_properties.inertia_O == b.mass_properties.inertia_O &&
         a.X_WO.matrix() == b.X_WO.matrix() && a.X_OL.matrix() == b.X_OL.matrix() && same_shapes(a.visual, b.visual) &&
         same_shapes(a.collision, b.collision);
}

bool same_scene(const scene::Scene& a, const scene::Scene& b) {
  const auto values = [](const scene::Scene& s) { return std::tie(s.name, s.path, s.gravity, s.force_scale); };
  return values(a) == values(b) &&
         std::equal(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), b.bodies.end(), same_body);
}

}  // namespace

bool has_file_colors(const geometry::Shape& shape) {
  const auto* mesh = std::get_if<geometry::MeshPtr>(&shape.geometry);
  if (mesh == nullptr || shape.color_given || (*mesh)->uri.empty()) return false;
  std::string ending = (*mesh)->uri.substr((*mesh)->uri.size() - std::min<std::size_t>(4, (*mesh)->uri.size()));
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending != ".stl";
}

SceneDescription describe(const scene::Scene& scene) {
  SceneDescription message;
  message.name = scene.name;
  message.path = scene.path;
  message.gravity = scene.gravity;
  message.force_scale = scene.force_scale;
  MeshIndices meshes;
  for (const scene::Body& body : scene.bodies) message.bodies.push_back(to_message(body, meshes, message));
  return message;
}

ScenePublisher::ScenePublisher(ros::NodeHandle private_node, std::string world_frame)
    : world_frame_(std::move(world_frame)),
      publisher_(private_node.advertise<SceneDescription>("scene_description", 1, true)) {}

void ScenePublisher::keep(const std::shared_ptr<const scene::Scene>& scene) {
  const bool is_new = scene != std::exchange(last_checked_, scene) && (!sent_ || !same_scene(*scene, *sent_));
  if (!is_new) return;
  sent_ = scene;
  SceneDescription message = describe(*scene);
  message.header.frame_id = world_frame_;
  message.header.stamp = ros::Time::now();
  publisher_.publish(message);
}

}  // namespace spring_workbench::markers
