#include "spring_workbench/geometry/solid_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "spring_workbench/geometry/surface.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::geometry::solid_contacts_test {
namespace {

const Solid cube{Box{Vector3d::Constant(0.1)}};

double deepest(const std::vector<BoxContact>& contacts) {
  double depth = 0.0;
  for (const BoxContact& c : contacts) depth = std::max(depth, -c.gap);
  return depth;
}

/// A prism along z over a star of four tips.
Geometry star() {
  TriangleMesh mesh;
  constexpr int n = 8;
  for (const double z : {-0.02, 0.02}) {
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * M_PI * i / n, r = i % 2 == 0 ? 0.04 : 0.015;
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
  }
  mesh.vertices.emplace_back(0.0, 0.0, -0.02);
  mesh.vertices.emplace_back(0.0, 0.0, 0.02);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.emplace_back(i, j, n + j);
    mesh.triangles.emplace_back(i, n + j, n + i);
    mesh.triangles.emplace_back(2 * n, j, i);
    mesh.triangles.emplace_back(2 * n + 1, n + i, n + j);
  }
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

TEST(Solids, SeamsAndGroovesAreNoEdges) {
  EXPECT_EQ(cube.edges.size(), 12U);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 20; ++i) {  // also where rounding makes two normals of one face
    TriangleMesh turned = *make_surface(Box{Vector3d::Constant(0.1)})->mesh;
    const Matrix3d R = math::exp_so3(Vector3d(unit(random), unit(random), unit(random)));
    for (Vector3d& vertex : turned.vertices) vertex = R * vertex;
    EXPECT_EQ(Solid(std::make_shared<const TriangleMesh>(std::move(turned))).edges.size(), 12U);
  }
  EXPECT_EQ(cube.corners.size(), 8U);
  EXPECT_EQ(Solid(star()).edges.size(), 4U + 16U);
}

TEST(Solids, BoxesTouchAsDeepAsTheyAre) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto in_cube = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
  for (int i = 0; i < 1000; ++i) {
    const Vector3d half_a = Vector3d::Constant(0.02) + 0.05 * in_cube().cwiseAbs();
    const Vector3d half_b = Vector3d::Constant(0.02) + 0.05 * in_cube().cwiseAbs();
    OutlineBox a{make_transform(0.05 * in_cube(), Quaterniond(math::exp_so3(3.0 * in_cube()))), half_a, true};
    const OutlineBox b{make_transform(0.05 * in_cube(), Quaterniond(math::exp_so3(3.0 * in_cube()))), half_b, true};
    BoxGap gap = gap_between(a, b);
    a.X.translation() += (-2e-5 - gap.gap) * gap.n_W;
    gap = gap_between(a, b);
    if (gap.gap > 0.0) continue;  // they pass by each other
    const auto contacts = solid_contacts(Solid(Box{2.0 * half_a}), a.X, Solid(Box{2.0 * half_b}), b.X, 0.0, 1e-3);
    EXPECT_TRUE(std::any_of(
        contacts.begin(), contacts.end(),
        [&](const BoxContact& c) { return std::abs(c.gap - gap.gap) < 1e-9 && c.n_W.dot(gap.n_W) > 1.0 - 1e-9; }))
        << i << ": " << gap.gap;
  }
}

TEST(Solids, FlushFacesTouchWithTheirCornersOnce) {
  for (const double y : {0.02, 0.03, -0.03}) {  // also where a corner is over a seam
    const RigidTransform above = make_transform(Vector3d(0.03, y, 0.1 + 1e-5), Quaterniond::Identity());
    const auto contacts = solid_contacts(cube, above, cube, RigidTransform::Identity(), 1e-4, 1e-3);
    EXPECT_EQ(contacts.size(), 4U) << y;
    for (const BoxContact& c : contacts) {
      EXPECT_NEAR(c.gap, 1e-5, 1e-12);
      EXPECT_NEAR(c.n_W.z(), 1.0, 1e-12);
      EXPECT_NEAR(c.p_W.z(), 0.05, 1e-12);
    }
  }
}

// In a groove between two faces, a corner behind both is in front of neither; such contacts used to be lost.
TEST(Solids, ACornerThatIsDeepInAGrooveTouchesBothFlanks) {
  const Vector3d groove = 0.015 * Vector3d(1.0, 1.0, 0.0).normalized();
  const Quaterniond corner_first = Quaterniond::FromTwoVectors(Vector3d(-1.0, -1.0, -1.0), -groove);
  for (const double depth : {-1e-6, 1e-8, 1e-6, 4e-5}) {
    const double from_corner = 0.05 * std::sqrt(3.0) - depth;
    const RigidTransform X = make_transform(groove + from_corner * groove.normalized(), corner_first);
    const auto contacts = solid_contacts(cube, X, Solid(star()), RigidTransform::Identity(), 1e-5, 1e-3);
    EXPECT_EQ(std::count_if(contacts.begin(), contacts.end(),
                            [&](const BoxContact& c) {
                              return c.n_W.z() == 0.0 &&
                                     std::abs(c.gap + depth * c.n_W.dot(groove.normalized())) < 1e-12;
                            }),
              2)
        << depth;
  }
}

TEST(Solids, ThroughAThinPlateNothingIsFelt) {
  const Solid plate{Box{{0.3, 0.3, 5e-4}}};
  const RigidTransform above = make_transform(Vector3d(0.0, 0.0, 0.05 + 2.5e-4 + 1e-4), Quaterniond::Identity());
  const auto contacts = solid_contacts(cube, above, plate, RigidTransform::Identity(), 1e-3, 1e-3);
  EXPECT_EQ(contacts.size(), 4U);
  for (const BoxContact& c : contacts) EXPECT_NEAR(c.gap, 1e-4, 1e-12);
}

RigidTransform at(double x, double y, double z) { return make_transform(Vector3d(x, y, z), Quaterniond::Identity()); }

TEST(Solids, OverlapHoweverTheyMeet) {
  const RigidTransform here = RigidTransform::Identity();
  const Solid bar{Box{{0.3, 0.01, 0.01}}}, across{Box{{0.01, 0.3, 0.01}}}, plate{Box{{0.3, 0.3, 0.002}}};
  const Solid rod{Cylinder{0.01, 0.3}}, coin{Cylinder{0.01, 0.002}}, small{Box{Vector3d::Constant(0.01)}},
      pointed(star());
  struct Case {
    const Solid &a, &b;
    RigidTransform X;
    bool expected;
  };
  const RigidTransform flat =
      make_transform(Vector3d(0.0, 0.0, 0.01), Quaterniond(Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitY())));
  const std::vector<Case> cases{{bar, across, at(0.0, 0.0, 0.005), true},  // edges alone
                                {bar, across, at(0.0, 0.0, 0.011), false},
                                {small, cube, at(0.01, 0.02, 0.0), true},  // as a whole
                                {small, cube, at(0.0, 0.0, 0.06), false},
                                {rod, plate, here, true},  // through the middle of a face
                                {rod, plate, at(0.0, 0.0, 0.152), false},
                                {coin, plate, at(0.0, 0.0, 0.001), true},
                                {rod, bar, here, true},
                                {rod, bar, flat * Eigen::Translation3d(0.0, 0.0, 0.0), true},
                                {rod, bar, at(0.0, 0.0, 0.16), false},
                                {coin, cube, at(0.0, 0.0, 0.02), true},
                                {small, rod, at(0.0, 0.0, 0.1), true},
                                {small, pointed, at(0.025, 0.025, 0.0), false},  // between two tips
                                {small, pointed, at(0.015, 0.015, 0.0), true}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    EXPECT_EQ(overlap(c.a, c.X, c.b, here), c.expected) << i;
    EXPECT_EQ(overlap(c.b, here, c.a, c.X), c.expected) << i;
  }
}

TEST(Solids, WhatIsDeepComesOutWhereItWentIn) {
  const Vector3d up = Vector3d::UnitZ();
  const Solid plate{Box{{0.3, 0.3, 5e-4}}}, rod{Cylinder{0.02, 0.1}};
  const auto below =
      exit_contact(plate, Vector3d(0.02, 0.03, 2.5e-4 - 3e-3), up, 3.2e-3, 1e-3);  // and out on the far side
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->gap, -3e-3, 1e-12);
  EXPECT_NEAR(below->p_W.z(), 2.5e-4, 1e-12);
  EXPECT_EQ(below->n_W, up);
  EXPECT_FALSE(exit_contact(plate, Vector3d(0.2, 0.0, -1e-3), up, 1.25e-3, 1e-3));  // beside it
  EXPECT_FALSE(exit_contact(cube, Vector3d(0.0, 0.0, 0.03), up, 2e-3, 1e-3));       // not there
  const auto side = exit_contact(rod, Vector3d(0.018, 0.0, 0.0), Vector3d::UnitX(), 2e-3, 1e-3);
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->gap, -2e-3, 1e-12);
  EXPECT_NEAR(side->n_W.x(), 1.0, 1e-12);
  const auto end = exit_contact(rod, Vector3d(0.018, 0.0, -0.048), -up, 2e-3, 1e-3);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->gap, -2e-3, 1e-12);
  EXPECT_NEAR(end->n_W.z(), -1.0, 1e-12);
}

TEST(Solids, ACylinderTouchesWithSideAndRims) {
  const Solid cylinder{Cylinder{0.02, 0.06}};
  for (const double turned : {0.0, 0.1, 1.0}) {  // about its axis, which lies along x
    const Quaterniond lying(Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitY()) *
                            Eigen::AngleAxisd(turned, Vector3d::UnitZ()));
    const RigidTransform X = make_transform(Vector3d(0.0, 0.0, 0.05 + 0.02 - 1e-5), lying);
    for (const bool first : {true, false}) {
      const auto contacts = first ? solid_contacts(cylinder, X, cube, RigidTransform::Identity(), 1e-5, 1e-3)
                                  : solid_contacts(cube, RigidTransform::Identity(), cylinder, X, 1e-5, 1e-3);
      Eigen::AlignedBox3d touched;
      for (const BoxContact& c : contacts) {
        if (std::abs(c.gap + 1e-5) < 1e-12) touched.extend(c.p_W);
      }
      EXPECT_NEAR(touched.sizes().x(), 0.06, 1e-12) << turned;
      EXPECT_NEAR(deepest(contacts), 1e-5, 1e-12) << turned;
    }
  }
  // Across an edge of the cube.
  const Quaterniond across(Eigen::AngleAxisd(0.25 * M_PI, Vector3d::UnitY()));
  const Vector3d middle = (0.05 * std::sqrt(2.0) + 0.02 + 1e-6) * Vector3d(1.0, 0.0, 1.0).normalized();
  const RigidTransform X =
      make_transform(middle, across * Quaterniond(Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitY())));
  const auto contacts = solid_contacts(cube, RigidTransform::Identity(), cylinder, X, 1e-5, 1e-3);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts[0].gap, 1e-6, 1e-12);
}

/// How far `a` reaches into `b` along a normal: what it has to move to be apart.
double depth_along(const Solid& a, const RigidTransform& X_WA, const Solid& b, const RigidTransform& X_WB,
                   const Vector3d& n_W) {
  const Vector3d lowest = X_WA * furthest(a, X_WA.linear().transpose() * -n_W);
  const Vector3d highest = X_WB * furthest(b, X_WB.linear().transpose() * n_W);
  return n_W.dot(highest - lowest);
}

/// A box and a cylinder, brought together from a random side until they touch, and a little further; tilted, flush, and
/// with equal sizes, so that rims meet edges. One of the contacts' normals separates them over no longer a way than
/// they have come, and no contact is deeper than they are along its normal.
TEST(Solids, ACylinderThatOverlapsABoxHasANormalThatSeparatesThem) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto direction = [&] { return Vector3d(unit(random), unit(random), unit(random)).normalized(); };
  for (int i = 0; i < 3000; ++i) {
    const Solid cylinder{i % 3 == 0 ? Cylinder{0.05, 0.1}
                                    : Cylinder{0.03 + 0.02 * unit(random), 0.06 + 0.05 * unit(random)}};
    const double tilt = i % 2 == 0 ? 3.0 : std::pow(10.0, -5.0 + 3.0 * unit(random));
    const RigidTransform X_WB = make_transform(Vector3d::Zero(), Quaterniond::UnitRandom());
    RigidTransform X_BC = RigidTransform::Identity();
    X_BC.linear() = math::exp_so3(tilt * direction());
    const Vector3d from = direction();
    double near = 0.0, far = 0.3;  // overlapping, apart
    const auto placed = [&](double way) {
      RigidTransform X = X_BC;
      X.translation() = way * from;
      return RigidTransform(X_WB * X);
    };
    const auto are_apart = [&](double way) { return !overlap(cylinder, placed(way), cube, X_WB); };
    for (int k = 0; k < 60; ++k) (are_apart(0.5 * (near + far)) ? far : near) = 0.5 * (near + far);
    const double depth = std::pow(10.0, -5.0 + unit(random));
    const RigidTransform X_WC = placed(far - depth);
    const auto contacts = solid_contacts(cylinder, X_WC, cube, X_WB, 0.0, 1e-3);
    double least = 1.0;
    for (const BoxContact& c : contacts) {
      const double along = depth_along(cylinder, X_WC, cube, X_WB, c.n_W);
      least = std::min(least, along);
      EXPECT_LE(-c.gap, along + 1e-9) << i;
    }
    EXPECT_LE(least, depth + 1e-7) << i << ' ' << contacts.size();
  }
}

}  // namespace
}  // namespace spring_workbench::geometry::solid_contacts_test
