#include "spring_workbench/geometry/orientation.h"

#include <algorithm>
#include <array>

namespace spring_workbench::geometry {
namespace {

/// Across each side of a triangle, from corner k to k + 1: the other triangle of this edge, or -1 if it is not shared
/// by exactly two.
std::vector<Eigen::Vector3i> neighbours(const TriangleMesh& mesh) {
  std::vector<std::array<int, 4>> sides;  // lower and higher vertex, triangle, k
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      sides.push_back({low, high, static_cast<int>(t), k});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<Eigen::Vector3i> across(mesh.triangles.size(), Eigen::Vector3i::Constant(-1));
  for (auto side = sides.begin(), end = side; side != sides.end(); side = end) {
    end = std::find_if(side, sides.end(), [&](const auto& s) { return s[0] != (*side)[0] || s[1] != (*side)[1]; });
    if (end - side != 2) continue;
    across[static_cast<std::size_t>(side[0][2])][side[0][3]] = side[1][2];
    across[static_cast<std::size_t>(side[1][2])][side[1][3]] = side[0][2];
  }
  return across;
}

/// Inverts these triangles if the volume that they enclose, seen from `middle`, is negative.
void turn_outward(TriangleMesh& mesh, const std::vector<std::size_t>& part, const Vector3d& middle) {
  double volume = 0.0;
  for (const std::size_t t : part) {
    Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = mesh.corner(mesh.triangles[t], k) - middle;
    volume += corners.determinant();
  }
  if (volume >= 0.0) return;
  for (const std::size_t t : part) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

/// Triangles that are connected across edges of exactly two of them.
struct Part {
  std::vector<std::size_t> triangles;
  bool closed = true;               ///< each edge is such an edge, and there are an inside and an outside
  bool consistent = true;           ///< all are counter-clockwise as seen from the same side
  std::vector<std::size_t> turned;  ///< those that are clockwise as seen from the side of the first
};

/// The part that the triangle `first` belongs to. `side`: 1 or -1 as in Part::turned; 0 if not yet found.
Part part_of(const TriangleMesh& mesh, const std::vector<Eigen::Vector3i>& across, std::size_t first,
             std::vector<int>& side) {
  Part part;
  part.triangles = {first};
  side[first] = 1;
  for (std::size_t i = 0; i < part.triangles.size(); ++i) {
    const std::size_t t = part.triangles[i];
    if (side[t] < 0) part.turned.push_back(t);
    for (int k = 0; k < 3; ++k) {
      if (across[t][k] < 0) part.closed = false;
      if (across[t][k] < 0) continue;
      const auto other = static_cast<std::size_t>(across[t][k]);
      const Eigen::Vector3i& u = mesh.triangles[other];
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      const bool same = (u[0] == a && u[1] == b) || (u[1] == a && u[2] == b) || (u[2] == a && u[0] == b);
      const int wanted = same ? -side[t] : side[t];
      if (side[other] == 0) part.triangles.push_back(other);
      if (side[other] == 0) side[other] = wanted;
      part.consistent = part.consistent && !same;
      part.closed = part.closed && side[other] == wanted;
    }
  }
  return part;
}

}  // namespace

void orient(TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : mesh.vertices) box.extend(v);
  const std::vector<Eigen::Vector3i> across = neighbours(mesh);
  std::vector<int> side(mesh.triangles.size(), 0);
  std::vector<std::size_t> rest;
  for (std::size_t first = 0; first < side.size(); ++first) {
    if (side[first] != 0) continue;
    const Part part = part_of(mesh, across, first, side);
    if (part.consistent || !part.closed) {
      rest.insert(rest.end(), part.triangles.begin(), part.triangles.end());
      continue;
    }
    for (const std::size_t t : part.turned) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    turn_outward(mesh, part.triangles, box.center());
  }
  turn_outward(mesh, rest, box.center());
}

}  // namespace spring_workbench::geometry
