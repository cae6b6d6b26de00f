#include "spring_workbench/collision/collision_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/moving_frames.h"
#include "spring_workbench/math/so3.h"
#include "support/meshes.h"
#include "support/random_poses.h"

namespace spring_workbench::collision::collision_world_test {
namespace {

using test_support::box_mesh;
using test_support::Random;
using test_support::sphere_mesh;

constexpr double far_below = -1e3;  // a bench out of reach

RigidTransform at(const Vector3d& p) { return RigidTransform(Eigen::Translation3d(p)); }

scene::Body body_of(const geometry::Geometry& geometry, const RigidTransform& X_WO = RigidTransform::Identity()) {
  scene::Body body;
  body.movable = true;
  body.X_WO = X_WO;
  body.collision = {geometry::Shape{geometry}};
  return body;
}

scene::Scene scene_of(const std::vector<scene::Body>& bodies, double bench_height = far_below) {
  scene::Scene scene;
  scene.bodies = bodies;
  scene.bench_height = bench_height;
  return scene;
}

std::vector<ContactPoint> contacts(const CollisionWorld& world, std::size_t body, const RigidTransform& X,
                                   double tolerance = 0.0) {
  std::vector<ContactPoint> found;
  world.find_contacts(body, X, tolerance, found);
  return found;
}

const ContactPoint& deepest(const std::vector<ContactPoint>& found) {
  return *std::max_element(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.depth < b.depth; });
}

std::vector<geometry::Geometry> one_of_each(Random& random) {
  const double a = random.number(0.02, 0.1), b = random.number(0.02, 0.1), c = random.number(0.02, 0.1);
  return {geometry::Box{Vector3d(a, b, c)}, geometry::Sphere{0.5 * a}, geometry::Cylinder{0.5 * b, c},
          box_mesh(Vector3d(b, c, a)), sphere_mesh(0.5 * c, 6)};
}

geometry::Box random_box(Random& random) {
  return geometry::Box{random.vector(0.05).cwiseAbs() + Vector3d::Constant(0.01)};
}

// ---- the bench

TEST(Bench, TheDeepestPointIsExactForEveryShape) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    for (const geometry::Geometry& shape : one_of_each(random)) {
      const double height = random.number(-1.0, 1.0);
      const CollisionWorld world(scene_of({body_of(shape)}, height));
      RigidTransform X = random.pose(0.1);
      X.translation().z() += height;
      const double lowest = geometry::bounding_box(shape, X).min().z();
      const auto found = contacts(world, 0, X);
      EXPECT_EQ(found.empty(), lowest >= height);
      EXPECT_EQ(world.touches(0, X, 0.0), lowest < height);
      if (found.empty()) continue;
      EXPECT_NEAR(deepest(found).depth, height - lowest, 1e-12);
      for (const ContactPoint& c : found) {
        EXPECT_EQ(c.other, CollisionWorld::bench);
        EXPECT_EQ(c.n_W, Vector3d::UnitZ());
        EXPECT_NEAR(c.p_W.z(), height, 1e-12);
        EXPECT_GT(c.depth, 0.0);
        const Vector3d inside = c.p_W - c.depth * c.n_W;  // the body's own point
        EXPECT_LT(geometry::bounding_box(shape, X).exteriorDistance(inside), 1e-12) << "is of the body";
      }
    }
  }
}

TEST(Bench, FlushFacesGivePointsThatSpanThem) {
  const double h = 0.02;
  for (const geometry::Geometry& shape :
       {geometry::Geometry(geometry::Box{Vector3d(0.1, 0.1, 0.04)}), geometry::Geometry(geometry::Cylinder{0.05, 0.04}),
        geometry::Geometry(box_mesh(Vector3d(0.1, 0.1, 0.04)))}) {
    const CollisionWorld world(scene_of({body_of(shape)}, 0.0));
    for (const double depth : {1e-5, 1e-12, -1e-6}) {
      const auto found = contacts(world, 0, at(Vector3d(0.3, 0.2, h - depth)), std::min(0.0, 2.0 * depth));
      ASSERT_GE(found.size(), 3u);
      Eigen::AlignedBox3d span;
      for (const ContactPoint& c : found) {
        EXPECT_NEAR(c.depth, depth, 1e-15);
        span.extend(c.p_W);
      }
      EXPECT_TRUE(span.isApprox(Eigen::AlignedBox3d(Vector3d(0.25, 0.15, 0.0), Vector3d(0.35, 0.25, 0.0)), 1e-9));
    }
  }
}

TEST(Bench, APointAboveItCountsAsFarAsTheToleranceIsNegative) {
  const CollisionWorld world(scene_of({body_of(geometry::Sphere{0.1})}, 0.0));
  EXPECT_TRUE(contacts(world, 0, at(Vector3d(0, 0, 0.1001)), -0.0002).size() == 1);
  EXPECT_TRUE(contacts(world, 0, at(Vector3d(0, 0, 0.1001)), -0.00005).empty());
  EXPECT_TRUE(world.touches(0, at(Vector3d(0, 0, 0.099)), 0.0005));
  EXPECT_FALSE(world.touches(0, at(Vector3d(0, 0, 0.099)), 0.0015));
}

TEST(Bench, AFineMeshGivesFewPointsThatKeepItsExtent) {
  const geometry::MeshPtr fine = sphere_mesh(0.1, 40);
  const CollisionWorld world(scene_of({body_of(fine)}, 0.0));
  const auto found = contacts(world, 0, at(Vector3d(0, 0, 0.05)));
  EXPECT_LE(found.size(), 9u);
  EXPECT_GE(found.size(), 5u);
  EXPECT_NEAR(deepest(found).depth, 0.05, 1e-12);
}

// ---- pairs

/// Checks minimum penetration: moving by the depth along `n` separates the bodies, and no shorter displacement in any
/// direction does.
void expect_least_way_out(const CollisionWorld& world, const RigidTransform& X, const ContactPoint& c, double slack,
                          Random& random) {
  const auto moved = [&](const Vector3d& by) { return RigidTransform(Eigen::Translation3d(by) * X); };
  EXPECT_NEAR(c.n_W.norm(), 1.0, 1e-9);
  EXPECT_FALSE(world.touches(0, moved((c.depth * (1.0 + slack) + 1e-9) * c.n_W), 0.0));
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(world.touches(0, moved((c.depth * (1.0 - slack) - 1e-9) * random.direction()), 0.0));
  }
}

TEST(Pairs, ASphereAndAPrimitiveAgreeWithTheLeastWayOut) {
  Random random(2);
  int touching = 0;
  for (int i = 0; i < 500; ++i) {
    const geometry::Sphere sphere{random.number(0.01, 0.06)};
    for (const geometry::Geometry& other :
         {geometry::Geometry(random_box(random)), geometry::Geometry(geometry::Sphere{random.number(0.01, 0.06)}),
          geometry::Geometry(geometry::Cylinder{random.number(0.01, 0.05), random.number(0.02, 0.1)})}) {
      const CollisionWorld world(scene_of({body_of(sphere), body_of(other, random.pose(0.03))}));
      const RigidTransform X = random.pose(0.06);
      const auto found = contacts(world, 0, X);
      EXPECT_EQ(found.empty(), !world.touches(0, X, 0.0));
      if (found.empty()) continue;
      ++touching;
      ASSERT_EQ(found.size(), 1u);
      EXPECT_EQ(found[0].other, 1u);
      expect_least_way_out(world, X, found[0], 1e-9, random);
    }
  }
  EXPECT_GT(touching, 500);
}

TEST(Pairs, ASphereAgreesWithTheDistanceToABox) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const geometry::Box box = random_box(random);
    const double radius = random.number(0.01, 0.05);
    const CollisionWorld world(scene_of({body_of(geometry::Sphere{radius}), body_of(box)}));
    const Vector3d centre = random.vector(0.1);
    const Vector3d gap = (centre.cwiseAbs() - 0.5 * box.size).cwiseMax(0.0);
    if (gap.norm() == 0.0) continue;  // the centre in the box
    const auto found = contacts(world, 0, at(centre), -1.0);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].depth, radius - gap.norm(), 1e-12);
    EXPECT_TRUE(found[0].n_W.isApprox(gap.cwiseProduct(centre.cwiseSign()).normalized(), 1e-9));
    EXPECT_NEAR(((found[0].p_W.cwiseAbs() - 0.5 * box.size).cwiseMax(0.0)).norm(), 0.0, 1e-12);
  }
}

/// Smallest overlap of two boxes over the fifteen axes of the separating axis theorem; negative if they are separate.
double overlap(const geometry::Box& a, const RigidTransform& X_WA, const geometry::Box& b, const RigidTransform& X_WB) {
  std::vector<Vector3d> axes;
  for (int i = 0; i < 3; ++i) {
    axes.push_back(X_WA.linear().col(i));
    axes.push_back(X_WB.linear().col(i));
    for (int j = 0; j < 3; ++j) axes.push_back(X_WA.linear().col(i).cross(X_WB.linear().col(j)));
  }
  double least = 1e9;
  for (const Vector3d& axis : axes) {
    if (axis.norm() < 1e-6) continue;
    const Vector3d n = axis.normalized();
    const double reach = 0.5 * ((X_WA.linear().transpose() * n).cwiseAbs().dot(a.size) +
                                (X_WB.linear().transpose() * n).cwiseAbs().dot(b.size));
    least = std::min(least, reach - std::abs(n.dot(X_WA.translation() - X_WB.translation())));
  }
  return least;
}

TEST(Pairs, TwoBoxesAgreeWithTheSeparatingAxisTheorem) {
  Random random(4);
  int touching = 0;
  for (int i = 0; i < 5000; ++i) {
    const geometry::Box a = random_box(random), b = random_box(random);
    RigidTransform X_WA = random.pose(0.06), X_WB = random.pose(0.06);
    if (i % 3 == 0) X_WA.linear() = X_WB.linear();  // parallel faces
    const CollisionWorld world(scene_of({body_of(a), body_of(b, X_WB)}));
    const double depth = overlap(a, X_WA, b, X_WB);
    const auto found = contacts(world, 0, X_WA);
    EXPECT_TRUE(depth < 1e-9 || !found.empty());
    EXPECT_TRUE(depth > -1e-9 || found.empty());
    if (found.empty()) continue;
    ++touching;
    const ContactPoint& c = deepest(found);
    EXPECT_GE(c.depth, depth - 1e-9);
    EXPECT_LE(c.depth, 1.06 * depth + 1e-9);  // a face is preferred to a pair of edges within five in a hundred
    for (const ContactPoint& point : found) {
      const Vector3d p_B = X_WB.inverse() * point.p_W;
      EXPECT_NEAR((p_B.cwiseAbs() - 0.5 * b.size).maxCoeff(), 0.0, 1e-9) << "is on the other's surface";
      EXPECT_TRUE(point.n_W.isApprox(c.n_W, 1e-9));
    }
    if (i % 10 == 0) expect_least_way_out(world, X_WA, c, 0.06, random);
  }
  EXPECT_GT(touching, 500);
}

/// Moves body 0 such that it penetrates body 1 by `depth` [m] along the shortest separating displacement. Returns false
/// if they are separate at first.
bool put_just_in(const geometry::Box& a, RigidTransform& X_WA, const geometry::Box& b, const RigidTransform& X_WB,
                 double depth, Vector3d& n) {
  const CollisionWorld world(scene_of({body_of(a), body_of(b, X_WB)}));
  auto found = contacts(world, 0, X_WA);
  if (found.empty()) return false;
  X_WA.translation() += (deepest(found).depth - depth) * deepest(found).n_W;
  found = contacts(world, 0, X_WA);
  if (found.empty() || std::abs(deepest(found).depth - depth) > 0.1 * depth) return false;
  n = deepest(found).n_W;
  return true;
}

TEST(Pairs, MeshesOfBoxesTouchAsTheBoxesDo) {
  Random random(5);
  int touching = 0;
  for (int i = 0; i < 600; ++i) {
    const geometry::Box a = random_box(random), b = random_box(random);
    RigidTransform X_WA = random.pose(0.05);
    const RigidTransform X_WB = random.pose(0.05);
    if (i % 3 == 0) X_WA.linear() = X_WB.linear();
    Vector3d n;
    constexpr double depth = 1e-5;
    if (!put_just_in(a, X_WA, b, X_WB, depth, n)) continue;
    ++touching;
    for (const auto& [own, other] : std::vector<std::pair<geometry::Geometry, geometry::Geometry>>{
             {box_mesh(a.size), b}, {a, box_mesh(b.size)}, {box_mesh(a.size), box_mesh(b.size)}}) {
      const CollisionWorld world(scene_of({body_of(own), body_of(other, X_WB)}));
      const auto found = contacts(world, 0, X_WA);
      ASSERT_FALSE(found.empty());
      EXPECT_LE(found.size(), 16u);
      for (const ContactPoint& c : found) {
        EXPECT_GT(c.n_W.dot(n), 0.99);  // a face within 8° of the edges' normal may be reported instead
        EXPECT_LT(c.depth, 1.2 * depth);
        const Vector3d p_B = X_WB.inverse() * c.p_W;
        EXPECT_NEAR((p_B.cwiseAbs() - 0.5 * b.size).maxCoeff(), 0.0, 1e-8);
      }
      EXPECT_GT(deepest(found).depth, 0.8 * depth);
      RigidTransform apart = X_WA;
      apart.translation() += 1.3 * depth * n;
      EXPECT_FALSE(world.touches(0, apart, 0.0));
    }
  }
  EXPECT_GT(touching, 100);
}

TEST(Pairs, ASphereOnAFineOrCoarseMeshOfABoxTouchesAsOnTheBox) {
  Random random(6);
  int touching = 0;
  for (int i = 0; i < 1000; ++i) {
    const geometry::Box box = random_box(random);
    const RigidTransform X_WB = random.pose(0.02);
    const geometry::Sphere sphere{random.number(0.01, 0.04)};
    const RigidTransform X = random.pose(0.06);
    const CollisionWorld exact(scene_of({body_of(sphere), body_of(box, X_WB)}));
    const CollisionWorld meshed(scene_of({body_of(sphere), body_of(box_mesh(box.size), X_WB)}));
    const auto expected = contacts(exact, 0, X);
    const auto found = contacts(meshed, 0, X);
    EXPECT_EQ(expected.empty(), found.empty());
    if (expected.empty() || expected[0].depth > sphere.radius) continue;  // the centre is outside
    ++touching;
    const ContactPoint& c = deepest(found);
    EXPECT_NEAR(c.depth, expected[0].depth, 1e-12);
    EXPECT_TRUE(c.n_W.isApprox(expected[0].n_W, 1e-7));
    EXPECT_TRUE(c.p_W.isApprox(expected[0].p_W, 1e-9));
  }
  EXPECT_GT(touching, 200);
}

TEST(Pairs, ASphereOnTheSeamOfAFlatFaceHasOneNormal) {
  const Vector3d size(0.2, 0.2, 0.1);
  const CollisionWorld world(scene_of({body_of(geometry::Sphere{0.03}), body_of(box_mesh(size))}));
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vector3d centre(random.number(-0.06, 0.06), random.number(-0.06, 0.06), 0.05 + 0.03 - 1e-4);
    for (const ContactPoint& c : contacts(world, 0, at(centre))) EXPECT_TRUE(c.n_W.isApprox(Vector3d::UnitZ(), 1e-9));
  }
}

TEST(Pairs, ToldFromTheOtherSideAContactIsTheSame) {
  Random random(8);
  int touching = 0;
  for (int i = 0; i < 150; ++i) {
    const auto shapes = one_of_each(random);
    for (const geometry::Geometry& a : shapes) {
      for (const geometry::Geometry& b : shapes) {
        const RigidTransform X_WA = random.pose(0.03), X_WB = random.pose(0.03);
        const CollisionWorld world(scene_of({body_of(a, X_WA), body_of(b, X_WB)}));
        const auto here = contacts(world, 0, X_WA);
        const auto there = contacts(world, 1, X_WB);
        ASSERT_EQ(here.empty(), there.empty());
        if (here.empty()) continue;
        ++touching;
        EXPECT_NEAR(deepest(here).depth, deepest(there).depth, 0.06 * deepest(here).depth + 1e-9);
      }
    }
  }
  EXPECT_GT(touching, 500);
}

TEST(Pairs, ContactsMoveWithTheWorld) {
  Random random(9);
  for (int i = 0; i < 50; ++i) {
    const auto shapes = one_of_each(random);
    for (const geometry::Geometry& a : shapes) {
      for (const geometry::Geometry& b : shapes) {
        const RigidTransform X_WA = random.pose(0.03), X_WB = random.pose(0.03), X = random.pose(1.0);
        const CollisionWorld here(scene_of({body_of(a), body_of(b, X_WB)}));
        const CollisionWorld there(scene_of({body_of(a), body_of(b, X * X_WB)}));
        const auto found = contacts(here, 0, X_WA);
        const auto moved = contacts(there, 0, X * X_WA);
        ASSERT_EQ(found.empty(), moved.empty());
        if (found.empty()) continue;
        EXPECT_NEAR(deepest(found).depth, deepest(moved).depth, 1e-9 + 1e-6 * deepest(found).depth);
      }
    }
  }
}

TEST(Pairs, FlushBoxesGivePointsThatSpanTheCommonFace) {
  const Vector3d base(0.3, 0.2, 0.1), top(0.1, 0.3, 0.04);
  constexpr double depth = 1e-6;
  for (const auto& [own, other] :
       std::vector<std::pair<geometry::Geometry, geometry::Geometry>>{{geometry::Box{top}, geometry::Box{base}},
                                                                      {box_mesh(top), geometry::Box{base}},
                                                                      {geometry::Box{top}, box_mesh(base)}}) {
    const CollisionWorld world(scene_of({body_of(own), body_of(other)}));
    for (const double z : {0.07 - depth, 0.07 + depth}) {
      const bool apart = z > 0.07;
      if (apart && !std::holds_alternative<geometry::Box>(own)) continue;  // negative tolerance is for flat neighbours:
      if (apart && !std::holds_alternative<geometry::Box>(other)) continue;  // the bench, boxes, spheres
      const auto found = contacts(world, 0, at(Vector3d(0.02, 0.01, z)), apart ? -2.0 * depth : 0.0);
      Eigen::AlignedBox3d span;
      for (const ContactPoint& c : found) {
        EXPECT_TRUE(c.n_W.isApprox(Vector3d::UnitZ(), 1e-6));
        EXPECT_NEAR(c.depth, 0.07 - z, 1e-12);
        span.extend(c.p_W);
      }
      ASSERT_GE(found.size(), 4u);
      EXPECT_LT((span.min() - Vector3d(-0.03, -0.1, 0.05)).norm(), 1e-5);
      EXPECT_LT((span.max() - Vector3d(0.07, 0.1, 0.05)).norm(), 1e-5);
    }
  }
}

TEST(Pairs, AFlushCylinderStandsOnThePointsOfItsRim) {
  for (const geometry::Geometry& base : {geometry::Geometry(geometry::Box{Vector3d(0.3, 0.2, 0.1)}),
                                         geometry::Geometry(box_mesh(Vector3d(0.3, 0.2, 0.1)))}) {
    const CollisionWorld world(scene_of({body_of(geometry::Cylinder{0.04, 0.06}), body_of(base)}));
    const auto found = contacts(world, 0, at(Vector3d(0.01, 0.02, 0.08 - 1e-6)));
    ASSERT_GE(found.size(), 3u);
    EXPECT_LE(found.size(), 9u);
    Eigen::AlignedBox3d span;
    for (const ContactPoint& c : found) {
      EXPECT_TRUE(c.n_W.isApprox(Vector3d::UnitZ(), 1e-9));
      EXPECT_NEAR(c.depth, 1e-6, 1e-12);
      EXPECT_NEAR((c.p_W - Vector3d(0.01, 0.02, 0.05)).norm(), 0.04, 1e-9);
      span.extend(c.p_W);
    }
    EXPECT_TRUE(span.contains(Vector3d(Vector3d(0.01, 0.02, 0.05)))) << "holds its centre up";
    EXPECT_GT(span.sizes().x(), 0.07);
    EXPECT_GT(span.sizes().y(), 0.07);
  }
}

/// On the middle of a large face, however it is tilted and turned, and as deep as its lowest point is.
TEST(Pairs, ACylinderIsAsDeepInABoxAsItsLowestPoint) {
  Random random(12);
  const geometry::Box base{Vector3d(2.0, 2.0, 0.1)};
  for (int i = 0; i < 300; ++i) {
    const geometry::Cylinder cylinder{random.number(0.01, 0.1), random.number(0.01, 0.2)};
    const RigidTransform X_WB = random.pose(0.3);
    RigidTransform X_BC = random.pose(0.0);
    if (i % 3 == 0) X_BC.linear() = Eigen::AngleAxisd(random.number(-3.0, 3.0), Vector3d::UnitX()) * X_BC.linear();
    if (i % 3 == 1)
      X_BC.linear() = math::shortest_rotation(Vector3d::UnitZ(), Vector3d(1.0, random.number(-1.0, 1.0), 0.0)) *
                      math::exp_so3(random.number(-3.0, 3.0) * Vector3d::UnitZ());  // on its side
    const double depth = std::pow(10.0, random.number(-5.5, -3.05));
    X_BC.translation().z() = 0.05 - depth - geometry::bounding_box(cylinder, X_BC).min().z();
    const CollisionWorld world(scene_of({body_of(cylinder), body_of(base, X_WB)}));
    const auto found = contacts(world, 0, X_WB * X_BC);
    ASSERT_FALSE(found.empty()) << i;
    EXPECT_NEAR(deepest(found).depth, depth, 1e-12) << i;
    for (const ContactPoint& c : found) EXPECT_LT((c.n_W - X_WB.linear().col(2)).norm(), 1e-9) << i;
    const auto open = contacts(world, 0, at(1.1 * depth * X_WB.linear().col(2)) * X_WB * X_BC, -0.2 * depth);
    ASSERT_FALSE(open.empty()) << i;
    EXPECT_NEAR(deepest(open).depth, -0.1 * depth, 1e-12) << i;
    EXPECT_TRUE(contacts(world, 0, at(1.1 * depth * X_WB.linear().col(2)) * X_WB * X_BC).empty()) << i;
  }
}

TEST(Pairs, ABodyThatIsWhollyInsideAnotherTouchesIt) {
  for (const geometry::Geometry& outer :
       {geometry::Geometry(geometry::Box{Vector3d::Constant(0.4)}),
        geometry::Geometry(box_mesh(Vector3d::Constant(0.4))), geometry::Geometry(sphere_mesh(0.3, 12)),
        geometry::Geometry(geometry::Sphere{0.3}), geometry::Geometry(geometry::Cylinder{0.3, 0.6})}) {
    Random random(10);
    for (const geometry::Geometry& inner : one_of_each(random)) {
      const CollisionWorld world(scene_of({body_of(inner), body_of(outer)}));
      for (std::size_t body : {0u, 1u}) {
        EXPECT_TRUE(world.touches(body, RigidTransform::Identity(), 0.0));
        const auto found = contacts(world, body, at(Vector3d(0.01, 0.02, 0.03)));
        ASSERT_FALSE(found.empty());
        EXPECT_GT(deepest(found).depth, 0.05);
        EXPECT_NEAR(deepest(found).n_W.norm(), 1.0, 1e-9);
      }
    }
  }
}

TEST(Pairs, InTheHollowOfABowlNothingIsTouched) {
  // A box with a box-shaped hollow: the outer surface and the inner one turned round.
  geometry::TriangleMesh hollow = *box_mesh(Vector3d::Constant(0.4));
  const geometry::TriangleMesh inner = *box_mesh(Vector3d::Constant(0.3));
  for (const Eigen::Vector3i& t : inner.triangles) hollow.triangles.emplace_back(t[0] + 8, t[2] + 8, t[1] + 8);
  hollow.vertices.insert(hollow.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  const geometry::Geometry bowl = std::make_shared<const geometry::TriangleMesh>(hollow);
  Random random(11);
  for (const geometry::Geometry& shape : one_of_each(random)) {
    const CollisionWorld world(scene_of({body_of(shape), body_of(bowl)}));
    EXPECT_FALSE(world.touches(0, at(Vector3d(0.02, 0.0, 0.0)), 0.0));
    const auto found = contacts(world, 0, at(Vector3d(0.0, 0.0, -0.15)));
    ASSERT_FALSE(found.empty());
    for (const ContactPoint& c : found) EXPECT_GT(c.n_W.z(), 0.99);
  }
}

TEST(Pairs, ARodThroughAPlateTouchesIt) {
  // No corner of one is inside the other, and the two curves push in opposite directions.
  for (const auto& [own, other] : std::vector<std::pair<geometry::Geometry, geometry::Geometry>>{
           {box_mesh(Vector3d(0.02, 0.02, 1.0)), geometry::Box{Vector3d(0.4, 0.4, 0.01)}},
           {geometry::Cylinder{0.01, 1.0}, geometry::Box{Vector3d(0.4, 0.4, 0.01)}},
           {geometry::Box{Vector3d(0.02, 0.02, 1.0)}, box_mesh(Vector3d(0.4, 0.4, 0.01))}}) {
    const CollisionWorld world(scene_of({body_of(own), body_of(other)}));
    EXPECT_TRUE(world.touches(0, at(Vector3d(0.03, 0.05, 0.0)), 1e-3));
  }
}

TEST(Pairs, ABodyWedgedBetweenTwoWallsOfOneMeshTouchesThem) {
  geometry::TriangleMesh walls = *box_mesh(Vector3d(0.1, 0.4, 0.4), at(Vector3d(-0.1, 0.0, 0.0)));
  const geometry::MeshPtr right = box_mesh(Vector3d(0.1, 0.4, 0.4), at(Vector3d(0.1, 0.0, 0.0)));
  for (const Eigen::Vector3i& t : right->triangles) walls.triangles.emplace_back(t + Eigen::Vector3i::Constant(8));
  walls.vertices.insert(walls.vertices.end(), right->vertices.begin(), right->vertices.end());
  const geometry::Geometry both = std::make_shared<const geometry::TriangleMesh>(walls);
  const CollisionWorld world(scene_of({body_of(geometry::Box{Vector3d(0.1 + 2e-4, 0.1, 0.1)}), body_of(both)}));
  int left_points = 0, right_points = 0;
  for (const ContactPoint& c : contacts(world, 0, RigidTransform::Identity())) {
    EXPECT_NEAR(c.depth, 1e-4, 1e-9);
    left_points += c.n_W.x() > 0.99;
    right_points += c.n_W.x() < -0.99;
  }
  EXPECT_GE(left_points, 4);
  EXPECT_GE(right_points, 4);
}

/// A slab with its top face, z = 0, cut into n × n squares.
geometry::MeshPtr divided_slab(double size, double thickness, int n) {
  geometry::TriangleMesh mesh;
  const double step = size / n;
  for (const double z : {0.0, -thickness}) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) mesh.vertices.emplace_back(i * step - 0.5 * size, j * step - 0.5 * size, z);
    }
  }
  const int layer = (n + 1) * (n + 1);
  const auto index = [&](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      test_support::add_quad(mesh, a, b, c, d);
      test_support::add_quad(mesh, a + layer, d + layer, c + layer, b + layer);
    }
    const auto side = [&](int from, int to) { test_support::add_quad(mesh, to, from, from + layer, to + layer); };
    side(index(i, 0), index(i + 1, 0));
    side(index(i + 1, n), index(i, n));
    side(index(0, i + 1), index(0, i));
    side(index(n, i), index(n, i + 1));
  }
  return std::make_shared<const geometry::TriangleMesh>(mesh);
}

TEST(Pairs, HowFinelyAFloorIsCutDoesNotShow) {
  Random random(14);
  for (const int n : {1, 7, 25}) {
    const geometry::MeshPtr floor = divided_slab(0.4, 0.05, n);
    ASSERT_NEAR(geometry::volume_properties(floor).volume, 0.4 * 0.4 * 0.05, 1e-12);
    for (int i = 0; i < 20; ++i) {
      const geometry::Box box = random_box(random);
      for (const geometry::Geometry& shape : {geometry::Geometry(box), geometry::Geometry(box_mesh(box.size)),
                                              geometry::Geometry(geometry::Cylinder{0.03, 0.05})}) {
        const bool upright = i % 2 == 0;
        if (!upright && std::holds_alternative<geometry::Cylinder>(shape)) continue;  // its prism ends a little earlier
        const CollisionWorld world(scene_of({body_of(shape), body_of(floor)}));
        RigidTransform X = random.pose(0.05);
        if (upright) X.linear() = Eigen::AngleAxisd(random.number(-3, 3), Vector3d::UnitZ()).toRotationMatrix();
        const double depth = std::pow(10.0, random.number(-6.0, -3.3));
        X.translation().z() += -depth - geometry::bounding_box(shape, X).min().z();
        const auto found = contacts(world, 0, X);
        ASSERT_FALSE(found.empty());
        EXPECT_LE(found.size(), 9u);
        EXPECT_GT(deepest(found).depth, 0.5 * depth);
        for (const ContactPoint& c : found) {
          EXPECT_GT(c.n_W.z(), upright ? 1.0 - 1e-12 : 0.999);  // a face of the box that is nearly flush may be taken
          EXPECT_LT(c.depth, depth * (1.0 + 1e-6));
        }
      }
    }
  }
}

TEST(Pairs, TwoFineSpheresTouchAsSpheresDo) {
  Random random(15);
  const geometry::MeshPtr ball = sphere_mesh(0.05, 30);
  const CollisionWorld world(scene_of({body_of(ball), body_of(ball)}));
  for (int i = 0; i < 40; ++i) {
    RigidTransform X = random.pose(0.0);
    const Vector3d n = random.direction();
    X.translation() = (0.1 - 5e-4) * n;
    const auto found = contacts(world, 0, X);
    ASSERT_FALSE(found.empty());
    for (const ContactPoint& c : found) {
      EXPECT_GT(c.n_W.dot(n), 0.97);
      EXPECT_LT(c.depth, 6e-4);
    }
  }
}

TEST(Pairs, EveryPieceOfABodyCountsAndItsOwnPiecesDoNot) {
  scene::Body two = body_of(geometry::Box{Vector3d::Constant(0.1)});
  two.collision.push_back(geometry::Shape{geometry::Box{Vector3d::Constant(0.1)}});
  two.collision[1].X_OS.translation() = Vector3d(0.5, 0, 0);
  two.collision.push_back(geometry::Shape{geometry::Sphere{0.06}});  // overlaps the first
  const CollisionWorld world(scene_of({two, body_of(geometry::Sphere{0.05}, at(Vector3d(0.5, 0, 0.09)))}));
  const auto found = contacts(world, 0, RigidTransform::Identity());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].other, 1u);
  EXPECT_TRUE(found[0].n_W.isApprox(-Vector3d::UnitZ()));
}

TEST(Pairs, BodiesAreWhereTheyWerePlacedLast) {
  CollisionWorld world(
      scene_of({body_of(geometry::Sphere{0.1}), body_of(geometry::Sphere{0.1}, at(Vector3d(1, 0, 0)))}));
  EXPECT_FALSE(world.touches(0, RigidTransform::Identity(), 0.0));
  world.set_pose(1, at(Vector3d(0.15, 0, 0)));
  EXPECT_TRUE(world.touches(0, RigidTransform::Identity(), 0.0));
  CollisionWorld moved = std::move(world);
  EXPECT_TRUE(moved.touches(0, RigidTransform::Identity(), 0.0));
  moved.set_pose(1, at(Vector3d(5, 5, 5)));
  EXPECT_FALSE(moved.touches(0, RigidTransform::Identity(), 0.0));
}

TEST(Pairs, ABodyWithoutShapesOrAWorldWithoutBodiesTouchesNothing) {
  CollisionWorld world(scene_of({scene::Body(), body_of(geometry::Sphere{0.1})}, 0.0));
  EXPECT_FALSE(world.touches(0, at(Vector3d(0, 0, -1)), 0.0));
  EXPECT_FALSE(world.may_touch(0, at(Vector3d(0, 0, -1)), at(Vector3d(0, 0, -2)), 0.1));
  EXPECT_FALSE(world.touches(1, at(Vector3d(0, 0, 1)), 0.0));
  const CollisionWorld empty(scene_of({}));
}

// ---- along a path

TEST(MayTouch, NeverSaysNoWrongly) {
  Random random(12);
  int yes = 0, no = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto shapes = one_of_each(random);
    scene::Body body = body_of(shapes[static_cast<std::size_t>(i) % shapes.size()]);
    body.collision[0].X_OS = random.pose(0.1);
    const CollisionWorld world(scene_of({body, body_of(shapes[0], random.pose(0.2))}, -0.25));
    const RigidTransform X0 = random.pose(0.2), X1 = random.pose(0.2);
    const double margin = random.number(0.0, 0.01);
    if (world.may_touch(0, X0, X1, margin)) {
      ++yes;
      continue;
    }
    ++no;
    const Vector3d turn = math::log_so3(X0.linear().transpose() * X1.linear());
    for (int k = 0; k <= 50; ++k) {
      RigidTransform X = RigidTransform::Identity();
      X.linear() = X0.linear() * math::exp_so3(k / 50.0 * turn);
      X.translation() = X0.translation() + k / 50.0 * (X1.translation() - X0.translation());
      EXPECT_FALSE(world.touches(0, X, 0.0));
    }
  }
  EXPECT_GT(yes, 100);
  EXPECT_GT(no, 100);
}

TEST(Sweep, FindsTheFractionAtWhichASphereMeetsTheBench) {
  const CollisionWorld world(scene_of({body_of(geometry::Sphere{0.1})}, 0.0));
  for (const int levels : {1, 8, 20}) {
    const SweepResult result = world.sweep(0, at(Vector3d(0, 0, 0.5)), at(Vector3d(0, 0, -0.5)), 0.0, 0.1, levels);
    ASSERT_TRUE(result.hit);
    EXPECT_LE(result.free_fraction, 0.4);
    EXPECT_GE(result.touching_fraction, 0.4);
    EXPECT_NEAR(result.touching_fraction - result.free_fraction, 0.1 / std::pow(2.0, levels), 1e-12);
  }
}

TEST(Sweep, SeesAThinWallAndATurn) {
  const CollisionWorld wall(
      scene_of({body_of(geometry::Sphere{0.01}), body_of(geometry::Box{Vector3d(0.001, 1.0, 1.0)})}));
  const SweepResult through = wall.sweep(0, at(Vector3d(-1, 0, 0)), at(Vector3d(1, 0, 0)), 0.0, 0.005, 30);
  ASSERT_TRUE(through.hit);
  EXPECT_NEAR(through.free_fraction, 0.5 - 0.0105 / 2.0, 1e-9);

  // A rod turns about its centre by 90°; a ball blocks it at 45°.
  const double s = std::sqrt(0.5);
  const CollisionWorld rod(scene_of({body_of(geometry::Box{Vector3d(1.0, 0.01, 0.01)}),
                                     body_of(geometry::Sphere{0.01}, at(Vector3d(0.45 * s, 0.45 * s, 0)))}));
  const RigidTransform quarter(Eigen::AngleAxisd(std::acos(0.0), Vector3d::UnitZ()));
  const SweepResult turn = rod.sweep(0, RigidTransform::Identity(), quarter, 0.0, 0.002, 30);
  ASSERT_TRUE(turn.hit);
  EXPECT_NEAR(turn.free_fraction, 0.5 - std::asin(0.015 / 0.45) / std::acos(0.0), 1e-6);
}

TEST(Sweep, TheFreeEndIsFreeAndTheTouchingEndTouches) {
  Random random(13);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const auto shapes = one_of_each(random);
    const CollisionWorld world(scene_of(
        {body_of(shapes[static_cast<std::size_t>(i) % 5]), body_of(shapes[static_cast<std::size_t>(i / 5) % 5])}));
    const RigidTransform X0 = random.pose(0.2), X1 = random.pose(0.2);
    const SweepResult result = world.sweep(0, X0, X1, 1e-6, 0.01, i % 2 ? 12 : 0);
    if (!result.hit || result.touching_fraction == 0.0) continue;
    ++hits;
    const Vector3d turn = math::log_so3(X0.linear().transpose() * X1.linear());
    const auto pose = [&](double f) {
      RigidTransform X = RigidTransform::Identity();
      X.linear() = X0.linear() * math::exp_so3(f * turn);
      X.translation() = X0.translation() + f * (X1.translation() - X0.translation());
      return X;
    };
    EXPECT_FALSE(world.touches(0, pose(result.free_fraction), 1e-6));
    EXPECT_TRUE(world.touches(0, pose(result.touching_fraction), 1e-6));
    const auto found = contacts(world, 0, pose(result.touching_fraction), 1e-6);
    ASSERT_FALSE(found.empty());
    const double path =
        (pose(result.touching_fraction).translation() - pose(result.free_fraction).translation()).norm() +
        0.1 * (result.touching_fraction - result.free_fraction) * turn.norm();
    for (const ContactPoint& c : found) EXPECT_LT(c.depth, 3.0 * path + 2e-6) << "deep where it only just touches";
  }
  EXPECT_GT(hits, 50);
}

TEST(Sweep, TheTimeOfImpactIsExact) {
  // A flying and turning box hits the bench: the time of impact of its lowest corner agrees with bisection of the
  // closed form.
  Random random(31);
  for (int i = 0; i < 100; ++i) {
    const geometry::Box shape{Vector3d(random.vector(0.1).cwiseAbs() + Vector3d::Constant(0.01))};
    const CollisionWorld world(scene_of({body_of(shape)}, 0.0));
    RigidTransform X0 = random.pose(0.1), X1 = random.pose(0.1);
    X0.translation().z() = 0.3;
    X1.translation().z() = -0.3;
    const Vector3d turn = math::log_so3(X0.linear().transpose() * X1.linear());
    const auto lowest = [&](double f) {
      const Matrix3d R = X0.linear() * math::exp_so3(f * turn);
      return 0.3 - 0.6 * f - 0.5 * R.row(2).cwiseAbs().dot(shape.size);
    };
    double above = 0.0, below = 1.0;
    for (int k = 1; k < 1000; ++k) {
      if (lowest(k / 1000.0) < 0.0) {
        above = (k - 1) / 1000.0;
        below = k / 1000.0;
        break;
      }
    }
    for (int k = 0; k < 50; ++k) (lowest(0.5 * (above + below)) > 0.0 ? above : below) = 0.5 * (above + below);
    const SweepResult result = world.sweep(0, X0, X1, 0.0, 0.001, 0);
    ASSERT_TRUE(result.hit);
    EXPECT_NEAR(result.free_fraction, above, 2e-7);
    EXPECT_NEAR(result.touching_fraction, above, 2e-7);
  }
}

TEST(Sweep, AStartInContactIsTold) {
  const CollisionWorld world(scene_of({body_of(geometry::Sphere{0.1})}, 0.0));
  const SweepResult result = world.sweep(0, at(Vector3d(0, 0, 0.05)), at(Vector3d(0, 0, 1)), 0.0, 0.01, 8);
  EXPECT_TRUE(result.hit);
  EXPECT_EQ(result.free_fraction, 0.0);
  EXPECT_EQ(result.touching_fraction, 0.0);
}

TEST(Sweep, AFreeWayIsFree) {
  const CollisionWorld world(scene_of({body_of(geometry::Sphere{0.1})}, 0.0));
  const SweepResult result = world.sweep(0, at(Vector3d(0, 0, 0.5)), at(Vector3d(1, 0, 0.11)), 0.0, 0.01, 8);
  EXPECT_FALSE(result.hit);
  EXPECT_EQ(result.free_fraction, 1.0);
}

}  // namespace
}  // namespace spring_workbench::collision::collision_world_test
