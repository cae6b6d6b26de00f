#include "spring_workbench/ros_interface/tube_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

namespace spring_workbench {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Signed volume by the divergence theorem: positive when all triangles face outwards.
double volume(const TriangleCorners& corners) {
  double six_volumes = 0.0;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    six_volumes += corners[i].dot(corners[i + 1].cross(corners[i + 2]));
  return six_volumes / 6.0;
}

/// Sum of the area vectors: zero for a closed surface.
Vector3d area_vector(const TriangleCorners& corners) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    sum += 0.5 * (corners[i + 1] - corners[i]).cross(corners[i + 2] - corners[i]);
  }
  return sum;
}

double area_of_polygon(double radius, int sides) { return 0.5 * sides * radius * radius * std::sin(2.0 * pi / sides); }

std::vector<RigidTransform> straight_line(double length, int count) {
  std::vector<RigidTransform> poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back(make_transform(Quaterniond::Identity(), Vector3d(0.0, 0.0, length * i / (count - 1))));
  }
  return poses;
}

TEST(Tube, StraightOneIsAPrism) {
  TriangleCorners corners;
  add_tube({Vector3d(1, 2, 3), Vector3d(1, 4, 3)}, 0.1, 8, corners);
  EXPECT_NEAR(volume(corners), 2.0 * area_of_polygon(0.1, 8), 1e-12);
}

TEST(Tube, AnyLineGivesAClosedSurfaceThatFacesOutwards) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 50; ++run) {
    std::vector<Vector3d> path{Vector3d::Zero()};
    Vector3d direction = Vector3d::UnitX();
    for (int i = 0; i < 20; ++i) {
      direction = (direction + 0.2 * Vector3d(normal(random), normal(random), normal(random))).normalized();
      path.push_back(path.back() + 0.1 * direction);
    }
    TriangleCorners corners;
    add_tube(path, 0.01, 6, corners);
    EXPECT_LT(area_vector(corners).norm(), 1e-12);
    EXPECT_NEAR(volume(corners), 2.0 * area_of_polygon(0.01, 6), 0.2 * 2.0 * area_of_polygon(0.01, 6));
  }
}

TEST(Tube, FewerThanTwoPointsAddNothing) {
  TriangleCorners corners;
  add_tube({}, 0.1, 6, corners);
  add_tube({Vector3d::Zero()}, 0.1, 6, corners);
  EXPECT_TRUE(corners.empty());
}

TEST(ForkMesh, StaysByItsCentrelineAndReachesTheTip) {
  const double length = 0.3;
  const ForkLook look;
  double highest = 0.0;
  for (const Vector3d& p : fork_mesh(straight_line(length, 33), length, look)) {
    EXPECT_LE(p.head<2>().norm(), (look.coil_radius + look.prong_gap + look.wire_radius) * length);
    highest = std::max(highest, p.z());
  }
  EXPECT_GE(highest, length);
  EXPECT_LE(highest, 1.1 * length);
}

TEST(ForkMesh, MovesWithTheCentreline) {
  const double length = 0.2;
  const auto straight = straight_line(length, 17);
  const RigidTransform X = make_transform(Quaterniond(0.3, -0.4, 0.5, 0.7), Vector3d(1, -2, 3));
  std::vector<RigidTransform> moved;
  for (const RigidTransform& pose : straight) moved.push_back(X * pose);
  const TriangleCorners a = fork_mesh(straight, length, ForkLook()), b = fork_mesh(moved, length, ForkLook());
  ASSERT_EQ(a.size(), b.size());
  // The tubes' first directions are free: compare what does not depend on them.
  EXPECT_NEAR(volume(a) / volume(b), 1.0, 0.02);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((X * a[i] - b[i]).norm(), 3.0 * ForkLook().wire_radius * length);
}

}  // namespace
}  // namespace spring_workbench
