#include "spring_workbench/geometry/surface.h"

#include <cmath>
#include <map>

#include "constants.h"
#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::geometry {
namespace {

void add_quad(TriangleMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.emplace_back(a, b, c);
  mesh.triangles.emplace_back(a, c, d);
}

MeshPtr box_mesh(const Box& box) {
  TriangleMesh mesh;
  for (const Vector3d& corner : corners(0.5 * box.size)) mesh.vertices.push_back(corner);
  add_quad(mesh, 0, 4, 6, 2);
  add_quad(mesh, 1, 3, 7, 5);
  add_quad(mesh, 0, 1, 5, 4);
  add_quad(mesh, 2, 6, 7, 3);
  add_quad(mesh, 0, 2, 3, 1);
  add_quad(mesh, 4, 5, 7, 6);
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

MeshPtr cylinder_mesh(const Cylinder& cylinder) {
  TriangleMesh mesh;
  const double half = 0.5 * cylinder.length;
  mesh.vertices = {Vector3d(0.0, 0.0, -half), Vector3d(0.0, 0.0, half)};
  for (int i = 0; i < cylinder_sides; ++i) {
    const double angle = 2.0 * M_PI * i / cylinder_sides;
    const Vector3d rim = cylinder.radius * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    mesh.vertices.push_back(rim - half * Vector3d::UnitZ());
    mesh.vertices.push_back(rim + half * Vector3d::UnitZ());
  }
  for (int i = 0; i < cylinder_sides; ++i) {
    const int low = 2 + 2 * i, next_low = 2 + 2 * ((i + 1) % cylinder_sides);
    add_quad(mesh, low, next_low, next_low + 1, low + 1);
    mesh.triangles.emplace_back(0, next_low, low);
    mesh.triangles.emplace_back(1, low + 1, next_low + 1);
  }
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

MeshPtr triangles_of(const Geometry& geometry) {
  if (const auto* box = std::get_if<Box>(&geometry)) return box_mesh(*box);
  if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) return cylinder_mesh(*cylinder);
  if (const auto* mesh = std::get_if<MeshPtr>(&geometry)) return *mesh;
  return nullptr;
}

void find_neighbours(const TriangleMesh& mesh, std::vector<std::array<int, 3>>& neighbours) {
  std::map<std::pair<int, int>, std::pair<int, int>> triangle_at;  // directed edge → triangle and its edge
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) triangle_at[{t[k], t[(k + 1) % 3]}] = {static_cast<int>(i), k};
  }
  neighbours.assign(mesh.triangles.size(), {-1, -1, -1});
  for (const auto& [edge, place] : triangle_at) {
    const auto opposite = triangle_at.find({edge.second, edge.first});
    if (opposite == triangle_at.end()) continue;
    neighbours[static_cast<std::size_t>(place.first)][static_cast<std::size_t>(place.second)] = opposite->second.first;
  }
}

}  // namespace

std::shared_ptr<const Surface> make_surface(const Geometry& geometry) {
  auto surface = std::make_shared<Surface>();
  surface->mesh = triangles_of(geometry);
  if (!surface->mesh) return nullptr;
  for (std::size_t i = 0; i < surface->mesh->triangles.size(); ++i) {
    const int t = static_cast<int>(i);
    const Vector3d& a = surface->corner(t, 0);
    surface->normals.push_back((surface->corner(t, 1) - a).cross(surface->corner(t, 2) - a).normalized());
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    surface->rounded_off = cylinder->radius * (1.0 - std::cos(M_PI / cylinder_sides));
  }
  find_neighbours(*surface->mesh, surface->neighbours);
  return surface;
}

}  // namespace spring_workbench::geometry
