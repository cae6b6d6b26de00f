// Meshes whose triangles disagree about inside and outside.
#include "spring_workbench/geometry/orientation.h"

#include <gtest/gtest.h>

#include <random>

#include "spring_workbench/geometry/shape_queries.h"
#include "support/meshes.h"

namespace spring_workbench::geometry::orientation_test {
namespace {

using Triangles = std::vector<Eigen::Vector3i>;

void add(TriangleMesh& mesh, const TriangleMesh& part, bool inverted = false) {
  const auto first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (Eigen::Vector3i t : part.triangles) {
    if (inverted) std::swap(t[1], t[2]);
    mesh.triangles.emplace_back(t.array() + first);
  }
}

/// Inverts some of the triangles from `begin` on, never all and never none.
TriangleMesh shuffled(TriangleMesh mesh, unsigned seed, std::size_t begin = 0) {
  std::mt19937 random(seed);
  for (std::size_t t = begin; t < mesh.triangles.size(); ++t) {
    const bool turn = t == begin || (t > begin + 1 && random() % 2 == 0);
    if (turn) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  return mesh;
}

double volume(const TriangleMesh& mesh) { return volume_properties(std::make_shared<const TriangleMesh>(mesh)).volume; }

/// Each triangle with its smallest vertex first, in the order in which it runs around.
Triangles normal_form(const TriangleMesh& mesh) {
  Triangles result;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    int k = 0;
    t.minCoeff(&k);
    result.emplace_back(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
  }
  return result;
}

const Vector3d size(0.1, 0.2, 0.3);

TEST(Orientation, AClosedMeshIsAsItWasBeforeItsTrianglesWereShuffled) {
  const TriangleMesh ball = *test_support::sphere_mesh(0.1, 12), box = *test_support::box_mesh(size);
  for (const TriangleMesh& good : {ball, box}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      TriangleMesh mesh = shuffled(good, seed);
      ASSERT_NE(normal_form(mesh), normal_form(good));
      orient(mesh);
      EXPECT_EQ(normal_form(mesh), normal_form(good));
    }
  }
}

TEST(Orientation, ACavityStaysOneAndAShuffledPartBesideItIsTurned) {
  TriangleMesh mesh;
  add(mesh, *test_support::box_mesh(size));
  add(mesh, *test_support::box_mesh(0.5 * size), true);
  const std::size_t beside = mesh.triangles.size();
  add(mesh, *test_support::box_mesh(size, make_transform(Vector3d(1.0, 0.0, 0.0), Quaterniond::Identity())));
  const TriangleMesh good = mesh;
  mesh = shuffled(mesh, 1, beside);
  for (std::size_t t = 0; t < beside; ++t) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);  // inside out
  orient(mesh);
  EXPECT_EQ(normal_form(mesh), normal_form(good));
  EXPECT_NEAR(volume(mesh), (2.0 - 0.125) * size.prod(), 1e-12);
}

TEST(Orientation, WhatHasNoInsideStaysAsItIs) {
  TriangleMesh open = shuffled(*test_support::box_mesh(size), 2);
  open.triangles.pop_back();
  if (volume(open) < 0.0) {
    for (Eigen::Vector3i& t : open.triangles) std::swap(t[1], t[2]);
  }
  const TriangleMesh before = open;
  orient(open);
  EXPECT_EQ(open.triangles, before.triangles);
}

}  // namespace
}  // namespace spring_workbench::geometry::orientation_test
