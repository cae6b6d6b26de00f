#include "benchmark/contact/pair_depth.h"

#include <gtest/gtest.h>

#include <random>

#include "benchmark/contact/bodies.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark::pair_depth_test {
namespace {

using geometry::Box;
using geometry::Cylinder;
using geometry::Geometry;
using geometry::Sphere;

double depth(const Geometry& a, const RigidTransform& X_WA, const Geometry& b, const RigidTransform& X_WB) {
  scene::Scene scene;
  scene.bench_height = -100.0;
  scene.bodies = {box("a", Vector3d::Ones(), 1.0, Vector3d::Zero()), standing("b", b, X_WB, 0.5)};
  scene.bodies[0].collision[0].geometry = a;
  return PairDepth(scene).deepest({X_WA, X_WB}).depth;
}

/// A box as a triangle mesh.
geometry::MeshPtr mesh_of(const Vector3d& size) {
  geometry::TriangleMesh mesh = *prism(std::vector<double>(4, std::sqrt(0.5)), 1.0);
  for (Vector3d& p : mesh.vertices) {
    p = (Eigen::AngleAxisd(0.25 * M_PI, Vector3d::UnitZ()) * p).cwiseProduct(size);
  }
  return std::make_shared<const geometry::TriangleMesh>(mesh);
}

/// The same, each layer moved along x by `slope` times its height.
geometry::MeshPtr leaning(const Vector3d& size, double slope) {
  geometry::TriangleMesh mesh = *mesh_of(size);
  for (Vector3d& p : mesh.vertices) p.x() += slope * p.z();
  return std::make_shared<const geometry::TriangleMesh>(mesh);
}

/// Random poses.
class PairDepthLaws : public ::testing::Test {
 protected:
  Vector3d in_cube() { return Vector3d(unit_(random_), unit_(random_), unit_(random_)); }
  RigidTransform anywhere() {
    RigidTransform X = at(in_cube());
    X.linear() = math::exp_so3(3.0 * in_cube());
    return X;
  }
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

TEST_F(PairDepthLaws, WhatIsPushedIntoAFaceIsAsDeepAsItIsPushed) {
  const std::vector<Geometry> all{Box{{0.2, 0.3, 0.1}}, Cylinder{0.1, 0.1}, Sphere{0.05}, mesh_of({0.2, 0.3, 0.1})};
  for (const Geometry& upper : all) {
    for (const Geometry& lower :
         {Geometry(Box{{1.0, 1.0, 0.4}}), Geometry(mesh_of({1.0, 1.0, 0.4})), Geometry(Cylinder{0.8, 0.4})}) {
      for (const double pushed : {1e-6, 1e-4, 5e-3, -1e-6, -0.02}) {
        const RigidTransform X_WB = anywhere();
        const RigidTransform X_WA = X_WB * at({0.01, 0.02, 0.2 + 0.05 - pushed});
        const double tolerance = 1e-12 + 1e-6 * std::abs(pushed);
        EXPECT_NEAR(depth(upper, X_WA, lower, X_WB), std::max(0.0, pushed), tolerance)
            << upper.index() << ' ' << lower.index() << ' ' << pushed;
      }
    }
  }
}

// Edges that lie in a face, or end on it, cross it or not as rounding has it.
TEST_F(PairDepthLaws, FlushFacesAreAsDeepAsRoundingPutsThem) {
  const double off = 1e-10;
  for (const double slope : {0.0, 0.1, -0.3}) {
    const Geometry left(leaning({0.04, 0.2, 0.08}, slope)), right(leaning({0.2, 0.2, 0.1}, slope));
    for (int i = 0; i < 1000; ++i) {
      RigidTransform X_WA = at(Vector3d(-0.12 + 0.002 * slope, 0.0, 0.002) + off * in_cube());
      X_WA.linear() = math::exp_so3(off * in_cube());
      EXPECT_LE(depth(left, X_WA, right, RigidTransform::Identity()), 4.0 * off) << slope << ", " << i;
    }
  }
}

TEST_F(PairDepthLaws, TheSameWayRoundOrTheOther) {
  const std::vector<Geometry> all{Box{{1.0, 0.6, 0.4}}, Cylinder{0.4, 0.8}, Sphere{0.5}, mesh_of({1.0, 0.6, 0.4}),
                                  Geometry(torus(0.5, 0.2))};
  int overlapping = 0;
  for (int i = 0; i < 100; ++i) {
    const Geometry &a = all[static_cast<std::size_t>(i) % all.size()], &b = all[static_cast<std::size_t>(i / 5) % 5];
    const RigidTransform X_WA = anywhere(), X_WB = anywhere();
    const double one = depth(a, X_WA, b, X_WB), other = depth(b, X_WB, a, X_WA);
    EXPECT_NEAR(one, other, 1e-9);
    overlapping += one > 0.0 ? 1 : 0;
  }
  EXPECT_GT(overlapping, 20);
}

TEST_F(PairDepthLaws, TrianglesOfABoxAreTheBox) {
  const Vector3d size(1.0, 0.6, 0.4);
  int overlapping = 0;
  for (int i = 0; i < 200; ++i) {
    const RigidTransform X_WA = anywhere(), X_WB = anywhere();
    const double of_cylinder = depth(Cylinder{0.2, 0.5}, X_WA, Box{size}, X_WB);
    EXPECT_NEAR(depth(Cylinder{0.2, 0.5}, X_WA, mesh_of(size), X_WB), of_cylinder, 1e-3) << i;
    EXPECT_NEAR(depth(Sphere{0.3}, X_WA, mesh_of(size), X_WB), depth(Sphere{0.3}, X_WA, Box{size}, X_WB), 1e-9) << i;
    overlapping += of_cylinder > 0.0 ? 1 : 0;
  }
  EXPECT_GT(overlapping, 20);
}

// Two linked rings: the overlap of two tubes, up to the polygons' sagitta of 0.1 mm.
TEST_F(PairDepthLaws, LinkedRingsTouchWhereTheirTubesMeet) {
  const double radius = 0.02, tube = 0.004;
  const geometry::MeshPtr ring = torus(radius, tube);
  for (const double pushed : {2e-4, 1e-3, -5e-4}) {
    RigidTransform X_WB = RigidTransform::Identity();
    X_WB.linear() = Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitX()).toRotationMatrix();
    X_WB.translation() = Vector3d(2.0 * (radius - tube) + pushed, 0.0, 0.0);
    EXPECT_NEAR(depth(ring, RigidTransform::Identity(), ring, X_WB), std::max(0.0, pushed), 1e-4) << pushed;
  }
}

TEST_F(PairDepthLaws, TheBenchIsLikeAnythingElse) {
  scene::Scene scene;
  scene.bodies = {box("a", {0.2, 0.2, 0.2}, 1.0, Vector3d::Zero())};
  EXPECT_NEAR(PairDepth(scene).deepest({at({0.0, 0.0, 0.099})}).depth, 1e-3, 1e-12);
  EXPECT_EQ(PairDepth(scene).deepest({at({0.0, 0.0, 0.101})}).depth, 0.0);
}

}  // namespace
}  // namespace spring_workbench::benchmark::pair_depth_test
