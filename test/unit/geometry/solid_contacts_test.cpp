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

}  // namespace
}  // namespace spring_workbench::geometry::solid_contacts_test
