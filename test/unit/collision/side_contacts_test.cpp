// Meshes at the side of a cylinder, compared with a search along their edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/math/so3.h"
#include "support/meshes.h"
#include "support/random_poses.h"

namespace spring_workbench::collision::side_contacts_test {
namespace {

using test_support::box_mesh;
using test_support::Random;
using test_support::sphere_mesh;

constexpr double radius = 0.008, rod_length = 2.0;

scene::Scene mesh_and_rod(const geometry::MeshPtr& mesh, const RigidTransform& X_WC) {
  scene::Scene scene;
  scene.bench_height = -1e3;
  scene.bodies.resize(2);
  scene.bodies[0].movable = true;
  scene.bodies[0].collision = {geometry::Shape{mesh}};
  scene.bodies[1].X_WO = X_WC;
  scene.bodies[1].collision = {geometry::Shape{geometry::Cylinder{radius, rod_length}}};
  return scene;
}

/// The point of the mesh's edges that is nearest to the z axis of C; along an edge the distance is convex.
Vector3d nearest_to_axis(const geometry::TriangleMesh& mesh, const RigidTransform& X_CM) {
  Vector3d nearest = Vector3d::Constant(std::numeric_limits<double>::max());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d a = X_CM * mesh.vertices[static_cast<std::size_t>(t[k])];
      const Vector3d b = X_CM * mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])];
      double low = 0.0, high = 1.0;
      const auto at = [&](double s) { return Vector3d(a + s * (b - a)); };
      for (int i = 0; i < 60; ++i) {
        const double s = low + (high - low) / 3.0, u = high - (high - low) / 3.0;
        if (at(s).head<2>().norm() < at(u).head<2>().norm()) {
          high = u;
        } else {
          low = s;
        }
      }
      const Vector3d p = at(0.5 * (low + high));
      if (p.head<2>().norm() < nearest.head<2>().norm()) nearest = p;
    }
  }
  return nearest;
}

TEST(CylinderSide, ItTouchesWhereAnEdgeComesNearestAndAsDeep) {
  Random random(71);
  for (int i = 0; i < 40; ++i) {
    const geometry::MeshPtr mesh = i % 2 ? box_mesh(random.vector(0.05).cwiseAbs() + Vector3d::Constant(0.02))
                                         : sphere_mesh(random.number(0.02, 0.05), 5);
    const RigidTransform X_WC = random.pose(0.1);
    RigidTransform X_CM = random.pose(0.02);
    X_CM.translation() += Vector3d(0.2, 0, 0);
    for (int k = 0; k < 12; ++k) {  // towards the axis until its nearest point is just in the cylinder
      X_CM.translation().x() -= nearest_to_axis(*mesh, X_CM).head<2>().norm() - (radius - 1e-5);
    }
    const CollisionWorld world(mesh_and_rod(mesh, X_WC));
    const Vector3d nearest = nearest_to_axis(*mesh, X_CM);
    ASSERT_NEAR(nearest.head<2>().norm(), radius - 1e-5, 1e-6);
    const double depth = radius - nearest.head<2>().norm();
    std::vector<ContactPoint> found;
    world.find_contacts(0, X_WC * X_CM, 0.0, found);
    ASSERT_FALSE(found.empty()) << i;
    double deepest = 0.0;
    for (const ContactPoint& c : found) {
      EXPECT_EQ(c.other, 1u);
      deepest = std::max(deepest, c.depth);
      const Vector3d p_C = X_WC.inverse() * c.p_W, n_C = X_WC.linear().transpose() * c.n_W;
      EXPECT_NEAR(p_C.head<2>().norm(), radius, 1e-12) << "on the cylinder";
      EXPECT_LT((n_C - Vector3d(p_C.x(), p_C.y(), 0.0) / radius).norm(), 1e-12) << "out of it";
    }
    EXPECT_NEAR(deepest, depth, 1e-10);
    EXPECT_TRUE(world.touches(0, X_WC * X_CM, 0.99 * depth));
    EXPECT_FALSE(world.touches(0, X_WC * X_CM, 1.01 * depth));
  }
}

TEST(CylinderSide, TheWayToItIsFreeUpToTheTolerance) {
  const geometry::MeshPtr mesh = sphere_mesh(0.03, 8);
  const CollisionWorld world(mesh_and_rod(mesh, RigidTransform::Identity()));
  Random random(72);
  for (int i = 0; i < 40; ++i) {
    RigidTransform X0 = random.pose(0.01), X1 = random.pose(0.01);
    X0.translation().x() += 0.15;
    X1.translation().x() -= 0.15;
    for (const double tolerance : {1e-6, 2e-5}) {
      const SweepResult result = world.sweep(0, X0, X1, tolerance, 2e-4, 0);
      ASSERT_TRUE(result.hit);
      RigidTransform X = X0;
      const Vector3d turn = math::log_so3(X0.linear().transpose() * X1.linear());
      X.linear() = X0.linear() * math::exp_so3(result.touching_fraction * turn);
      X.translation() += result.touching_fraction * (X1.translation() - X0.translation());
      EXPECT_NEAR(radius - nearest_to_axis(*mesh, X).head<2>().norm(), tolerance, 2e-8);
    }
  }
}

TEST(CylinderSide, NothingIsMissedAtItsEndsThroughFacesAndInside) {
  // A box of 40 mm: at the rod's end, pierced by it, around a short rod whole; and clear of it beyond its end.
  const geometry::MeshPtr mesh = box_mesh(Vector3d::Constant(0.04));
  const CollisionWorld world(mesh_and_rod(mesh, RigidTransform::Identity()));
  const auto touches_at = [&](const Vector3d& p) {
    return world.touches(0, RigidTransform(Eigen::Translation3d(p)), 1e-6);
  };
  const double end = 0.5 * rod_length;
  EXPECT_TRUE(touches_at(Vector3d(0, 0, end + 0.02 - 1e-5)));
  EXPECT_FALSE(touches_at(Vector3d(0, 0, end + 0.02 + 1e-5)));
  EXPECT_TRUE(touches_at(Vector3d(0.001, 0.002, 0.3)));
  EXPECT_TRUE(touches_at(Vector3d(0.02 + radius - 1e-5, 0, end)));
  EXPECT_FALSE(touches_at(Vector3d(0.02 + radius + 1e-5, 0, end)));
  scene::Scene around = mesh_and_rod(mesh, RigidTransform::Identity());
  around.bodies[1].collision = {geometry::Shape{geometry::Cylinder{radius, 0.02}}};
  EXPECT_TRUE(CollisionWorld(around).touches(0, RigidTransform::Identity(), 1e-6));
}

}  // namespace
}  // namespace spring_workbench::collision::side_contacts_test
