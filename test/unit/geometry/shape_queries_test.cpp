#include "spring_workbench/geometry/shape_queries.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "spring_workbench/math/so3.h"
#include "support/meshes.h"

namespace spring_workbench::geometry::shape_queries_test {
namespace {

constexpr double pi = 3.14159265358979323846;
using test_support::box_mesh;
using test_support::sphere_mesh;

Vector3d random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> number(-size, size);
  const double x = number(random), y = number(random), z = number(random);
  return {x, y, z};
}

RigidTransform random_pose(std::mt19937& random, double size) {
  RigidTransform X = RigidTransform::Identity();
  X.linear() = math::exp_so3(random_vector(random, 3.0));
  X.translation() = random_vector(random, size);
  return X;
}

TEST(VolumeProperties, ABoxIsExact) {
  const VolumeProperties box = volume_properties(Box{Vector3d(0.2, 0.3, 0.5)});
  EXPECT_DOUBLE_EQ(box.volume, 0.03);
  EXPECT_TRUE(box.centre.isZero());
  const Vector3d expected = 0.03 / 12.0 * Vector3d(0.09 + 0.25, 0.04 + 0.25, 0.04 + 0.09);
  EXPECT_TRUE(box.inertia_per_density.isApprox(Matrix3d(expected.asDiagonal()), 1e-14));
}

TEST(VolumeProperties, SphereAndCylinderAreExact) {
  const VolumeProperties sphere = volume_properties(Sphere{0.3});
  EXPECT_DOUBLE_EQ(sphere.volume, 4.0 / 3.0 * pi * 0.027);
  EXPECT_TRUE(sphere.inertia_per_density.isApprox(0.4 * sphere.volume * 0.09 * Matrix3d::Identity(), 1e-14));

  const VolumeProperties cylinder = volume_properties(Cylinder{0.2, 0.7});
  EXPECT_DOUBLE_EQ(cylinder.volume, pi * 0.04 * 0.7);
  EXPECT_NEAR(cylinder.inertia_per_density(2, 2), 0.5 * cylinder.volume * 0.04, 1e-15);
  EXPECT_NEAR(cylinder.inertia_per_density(0, 0), cylinder.volume * (3.0 * 0.04 + 0.49) / 12.0, 1e-15);
}

TEST(VolumeProperties, AMeshOfABoxIsTheBoxWhereverItStands) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const Vector3d size = random_vector(random, 0.5).cwiseAbs() + Vector3d::Constant(0.01);
    const RigidTransform X = random_pose(random, 5.0);
    const VolumeProperties box = volume_properties(Box{size});
    const VolumeProperties mesh = volume_properties(box_mesh(size, X));
    EXPECT_NEAR(mesh.volume, box.volume, 1e-12 * box.volume + 1e-16);
    EXPECT_TRUE(mesh.centre.isApprox(X.translation(), 1e-12));
    const Matrix3d expected = X.linear() * box.inertia_per_density * X.linear().transpose();
    EXPECT_LT((mesh.inertia_per_density - expected).norm(), 1e-11 * expected.norm());
  }
}

TEST(VolumeProperties, AFineMeshOfASphereComesNearTheSphereFromBelow) {
  const VolumeProperties exact = volume_properties(Sphere{0.1});
  double last_error = 1.0;
  for (const int rings : {7, 15, 31, 63}) {
    const double error = 1.0 - volume_properties(sphere_mesh(0.1, rings)).volume / exact.volume;
    EXPECT_GT(error, 0.0);
    EXPECT_NEAR(last_error / error, 4.0, rings == 7 ? 1e3 : 0.3) << "second order in the edge length";
    last_error = error;
  }
}

TEST(Contains, AMeshAnswersAsThePrimitiveItIsMadeFrom) {
  std::mt19937 random(11);
  const Vector3d size(0.1, 0.06, 0.04);
  const MeshPtr mesh = box_mesh(size, RigidTransform::Identity());
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = random_vector(random, 0.06);
    EXPECT_EQ(contains(mesh, p), contains(Box{size}, p)) << p.transpose();
    inside += contains(mesh, p);
  }
  EXPECT_GT(inside, 100);
  EXPECT_LT(inside, 1900);
}

TEST(Contains, TheShareOfPointsInsideIsTheVolume) {
  std::mt19937 random(13);
  for (const Geometry& shape : {Geometry(Box{Vector3d(0.7, 0.5, 0.9)}), Geometry(Sphere{0.4}),
                                Geometry(Cylinder{0.3, 0.8}), Geometry(sphere_mesh(0.4, 12))}) {
    constexpr int count = 20000;
    int inside = 0;
    for (int i = 0; i < count; ++i) inside += contains(shape, random_vector(random, 0.5));
    const double expected = volume_properties(shape).volume;
    EXPECT_NEAR(static_cast<double>(inside) / count, expected, 5.0 * std::sqrt(expected * (1.0 - expected) / count));
  }
}

/// Points of the surface of a shape, dense enough for 1e-3.
std::vector<Vector3d> surface_points(const Geometry& shape) {
  std::vector<Vector3d> points;
  if (const auto* s = std::get_if<Sphere>(&shape)) return sphere_mesh(s->radius, 60)->vertices;
  if (const auto* b = std::get_if<Box>(&shape)) return box_mesh(b->size, RigidTransform::Identity())->vertices;
  if (const auto* m = std::get_if<MeshPtr>(&shape)) return (*m)->vertices;
  const auto& c = std::get<Cylinder>(shape);
  for (int i = 0; i < 720; ++i) {
    const double a = 2.0 * pi * i / 720.0;
    for (const double z : {-0.5, 0.5})
      points.emplace_back(c.radius * std::cos(a), c.radius * std::sin(a), z * c.length);
  }
  return points;
}

TEST(BoundingBox, HoldsTheShapeAndTouchesItOnAllSides) {
  std::mt19937 random(17);
  for (const Geometry& shape : {Geometry(Box{Vector3d(0.7, 0.5, 0.9)}), Geometry(Sphere{0.4}),
                                Geometry(Cylinder{0.3, 0.8}), Geometry(sphere_mesh(0.4, 12))}) {
    for (int i = 0; i < 20; ++i) {
      const RigidTransform X = random_pose(random, 1.0);
      Eigen::AlignedBox3d around;
      for (const Vector3d& p : surface_points(shape)) around.extend(Vector3d(X * p));
      const Eigen::AlignedBox3d box = bounding_box(shape, X);
      EXPECT_LT((box.min() - around.min()).cwiseAbs().maxCoeff(), 1.5e-3);
      EXPECT_LT((box.max() - around.max()).cwiseAbs().maxCoeff(), 1.5e-3);
      EXPECT_TRUE((box.min().array() <= around.min().array() + 1e-12).all());
      EXPECT_TRUE((box.max().array() >= around.max().array() - 1e-12).all());
    }
  }
}

TEST(BoundingRadius, IsTheFarthestPointOfTheBody) {
  std::mt19937 random(19);
  for (int i = 0; i < 50; ++i) {
    scene::Body body;
    double farthest = 0.0;
    for (const Geometry& shape : {Geometry(Box{Vector3d(0.7, 0.5, 0.9)}), Geometry(Sphere{0.4}),
                                  Geometry(Cylinder{0.3, 0.8}), Geometry(sphere_mesh(0.4, 12))}) {
      body.collision = {Shape{shape, random_pose(random, 1.0)}};
      farthest = 0.0;
      for (const Vector3d& p : surface_points(shape))
        farthest = std::max(farthest, (body.collision[0].X_OS * p).norm());
      EXPECT_NEAR(bounding_radius(body.collision), farthest, 1.5e-3);
      EXPECT_GE(bounding_radius(body.collision), farthest - 1e-12);
    }
  }
}

TEST(Body, WithoutShapesIsEmpty) {
  const scene::Body body;
  EXPECT_TRUE(bounding_box(body.collision).isEmpty());
  EXPECT_FALSE(contains(body.collision, Vector3d::Zero()));
  EXPECT_EQ(bounding_radius(body.collision), 0.0);
}

TEST(Body, ContainsWhatOneOfItsPlacedShapesContains) {
  scene::Body body;
  Shape ball{Sphere{0.1}};
  ball.X_OS.translation() = Vector3d(1.0, 0.0, 0.0);
  body.collision = {Shape{Box{Vector3d::Constant(0.1)}}, ball};
  EXPECT_TRUE(contains(body.collision, Vector3d(0.04, 0.04, 0.04)));
  EXPECT_TRUE(contains(body.collision, Vector3d(1.05, 0.05, 0.0)));
  EXPECT_FALSE(contains(body.collision, Vector3d(0.5, 0.0, 0.0)));
  EXPECT_TRUE(
      bounding_box(body.collision).isApprox(Eigen::AlignedBox3d(Vector3d(-0.05, -0.1, -0.1), Vector3d(1.1, 0.1, 0.1))));
}

}  // namespace
}  // namespace spring_workbench::geometry::shape_queries_test
