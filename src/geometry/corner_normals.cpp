#include "spring_workbench/geometry/corner_normals.h"

#include <Eigen/Geometry>

#include "constants.h"

namespace spring_workbench::geometry {

using Eigen::Vector3f;

std::vector<Vector3f> corner_normals(const std::vector<float>& vertices, const std::vector<std::uint32_t>& triangles) {
  const auto point = [&](std::size_t corner) { return Vector3f(&vertices[3 * std::size_t{triangles[corner]}]); };
  std::vector<Vector3f> of_triangle;  // with lengths equal to twice the areas
  std::vector<std::vector<std::size_t>> at_vertex(vertices.size() / 3);
  for (std::size_t corner = 0; corner + 2 < triangles.size(); corner += 3) {
    of_triangle.push_back((point(corner + 1) - point(corner)).cross(point(corner + 2) - point(corner)));
    for (std::size_t k = 0; k < 3; ++k) at_vertex[triangles[corner + k]].push_back(corner / 3);
  }
  std::vector<Vector3f> normals;
  for (std::size_t corner = 0; corner < 3 * of_triangle.size(); ++corner) {
    const std::vector<std::size_t>& neighbours = at_vertex[triangles[corner]];
    const Vector3f own = of_triangle[corner / 3].normalized();
    Vector3f sum = Vector3f::Zero();
    for (const std::size_t other : neighbours) {
      if (neighbours.size() > max_smoothed_triangles) break;
      if (other == corner / 3 || own.dot(of_triangle[other].normalized()) > crease_cosine) sum += of_triangle[other];
    }
    normals.push_back(neighbours.size() > max_smoothed_triangles ? own : Vector3f(sum.normalized()));
  }
  return normals;
}

}  // namespace spring_workbench::geometry
