#include "spring_workbench/ros_interface/tube_mesh.h"

#include <algorithm>
#include <cmath>

namespace spring_workbench {
namespace {

constexpr double pi = 3.14159265358979323846;

Vector3d tangent(const std::vector<Vector3d>& path, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = std::min(i + 1, path.size() - 1);
  return (path[after] - path[before]).normalized();
}

/// Points around each point of the path, the first direction carried along without twist.
std::vector<std::vector<Vector3d>> rings(const std::vector<Vector3d>& path, double radius, int sides) {
  std::vector<std::vector<Vector3d>> result;
  Vector3d x = tangent(path, 0).unitOrthogonal();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector3d t = tangent(path, i);
    x = (x - t * t.dot(x)).normalized();
    const Vector3d y = t.cross(x);
    std::vector<Vector3d> ring;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * pi * k / sides;
      ring.push_back(path[i] + radius * (std::cos(angle) * x + std::sin(angle) * y));
    }
    result.push_back(ring);
  }
  return result;
}

void add_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, TriangleCorners& corners) {
  corners.insert(corners.end(), {a, b, c});
}

/// The pose at the share `u` (0 … 1) of the rod; beyond the tip, straight on.
RigidTransform pose_at(const std::vector<RigidTransform>& centreline, double length, double u) {
  const double place = std::clamp(u, 0.0, 1.0) * static_cast<double>(centreline.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), centreline.size() - 2);
  const double part = place - static_cast<double>(i);
  const RigidTransform& a = centreline[i];
  const RigidTransform& b = centreline[i + 1];
  RigidTransform X = RigidTransform::Identity();
  X.linear() = Quaterniond(a.linear()).slerp(part, Quaterniond(b.linear())).toRotationMatrix();
  X.translation() = (1.0 - part) * a.translation() + part * b.translation();
  X.translate(Vector3d(0.0, 0.0, std::max(u - 1.0, 0.0) * length));
  return X;
}

std::vector<Vector3d> coil(const std::vector<RigidTransform>& centreline, double length, const ForkLook& look) {
  constexpr int points_per_turn = 12;
  const int count = look.turns * points_per_turn;
  std::vector<Vector3d> path{centreline.front().translation()};
  for (int k = 0; k <= count; ++k) {
    const double share = static_cast<double>(k) / count;
    const double angle = 2.0 * pi * look.turns * share;
    const double widening =
        std::min({1.0, share * look.turns, (1.0 - share) * look.turns});  // in the first and last turn
    const double radius = look.coil_radius * length * widening;
    const RigidTransform X = pose_at(centreline, length, look.coil_begin + share * (look.coil_end - look.coil_begin));
    path.push_back(X * Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0.0));
  }
  return path;
}

std::vector<Vector3d> prong(const std::vector<RigidTransform>& centreline, double length, const ForkLook& look,
                            double offset) {
  std::vector<Vector3d> path{pose_at(centreline, length, look.coil_end).translation()};
  for (const double u : {0.86, 0.9, 0.95, 1.0, 1.04}) {
    path.push_back(pose_at(centreline, length, u) * Vector3d(offset * length, 0.0, 0.0));
  }
  return path;
}

}  // namespace

void add_tube(const std::vector<Vector3d>& path, double radius, int sides, TriangleCorners& corners) {
  if (path.size() < 2) return;
  const auto all = rings(path, radius, sides);
  const auto count = static_cast<std::size_t>(sides);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      add_triangle(all[i][k], all[i][next], all[i + 1][next], corners);
      add_triangle(all[i][k], all[i + 1][next], all[i + 1][k], corners);
    }
    add_triangle(path.front(), all.front()[next], all.front()[k], corners);
    add_triangle(path.back(), all.back()[k], all.back()[next], corners);
  }
}

TriangleCorners fork_mesh(const std::vector<RigidTransform>& centreline, double length, const ForkLook& look) {
  constexpr int sides = 6;
  TriangleCorners corners;
  add_tube(coil(centreline, length, look), look.wire_radius * length, sides, corners);
  for (const double offset : {-look.prong_gap, 0.0, look.prong_gap}) {
    add_tube(prong(centreline, length, look, offset), look.prong_radius * length, sides, corners);
  }
  return corners;
}

}  // namespace spring_workbench
