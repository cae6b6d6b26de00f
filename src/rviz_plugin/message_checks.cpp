#include "message_checks.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::rviz_plugin {
namespace {

using validation::refuse;

/// Finite in single precision, too, which is used for drawing.
bool is_drawable(double x) { return std::isfinite(static_cast<float>(x)); }

void check_mesh(const MeshDescription& mesh) {
  const std::size_t vertices = mesh.vertices.size() / 3;
  if (mesh.vertices.size() % 3 != 0 || mesh.triangles.size() % 3 != 0)
    refuse(mesh.uri, "vertices and triangles", "three numbers each");
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_drawable))
    refuse(mesh.uri, "vertices", "finite numbers");
  if (std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](std::uint32_t i) { return i >= vertices; }))
    refuse(mesh.uri, "triangles", "indices of vertices");
}

void check_shape(const ShapeDescription& shape, std::size_t meshes, const std::string& of) {
  check(shape.pose, of);
  if (shape.type > ShapeDescription::MESH)
    refuse(of, "type", std::to_string(shape.type), "BOX, SPHERE, CYLINDER or MESH");
  if (shape.type == ShapeDescription::MESH && shape.mesh >= meshes)
    refuse(of, "mesh", std::to_string(shape.mesh), "an index of meshes");
  const auto& size = shape.size;
  if (!is_drawable(size.x) || !is_drawable(size.y) || !is_drawable(size.z)) refuse(of, "size", "finite numbers");
  const auto& color = shape.color;
  if (!std::isfinite(color.r + color.g + color.b + color.a)) refuse(of, "color", "finite numbers");
}

}  // namespace

bool is_pose(const geometry_msgs::Pose& pose) {
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  return is_drawable(p.x) && is_drawable(p.y) && is_drawable(p.z) &&
         std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0) < 0.1;
}

void check(const geometry_msgs::Pose& pose, const std::string& of) {
  if (!is_pose(pose)) refuse(of, "pose", "a finite pose with a quaternion of length 1");
}

void check(const SceneDescription& scene) {
  for (const MeshDescription& mesh : scene.meshes) check_mesh(mesh);
  std::set<std::string> names;
  for (const BodyDescription& body : scene.bodies) {
    if (!names.insert(body.name).second) refuse(body.name, "name", "a unique name");
    check(body.pose, body.name);
    for (const ShapeDescription& shape : body.visual) check_shape(shape, scene.meshes.size(), body.name);
  }
}

}  // namespace spring_workbench::rviz_plugin
