// Meshes that are not the surface of a solid: contact with them is finite and bounded, and ends.
#include <gtest/gtest.h>

#include <cmath>

#include "spring_workbench/contact/contact_engines.h"
#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"
#include "support/meshes.h"
#include "support/random_poses.h"

namespace spring_workbench::simulation::broken_meshes_test {
namespace {

using test_support::box_mesh;
using test_support::Random;
using test_support::sphere_mesh;

constexpr double edge = 0.06;  // m

geometry::MeshPtr mesh_of(geometry::TriangleMesh mesh) {
  return std::make_shared<const geometry::TriangleMesh>(std::move(mesh));
}

struct Broken {
  std::string what;
  geometry::MeshPtr mesh;
};

std::vector<Broken> broken_meshes() {
  const geometry::TriangleMesh good = *box_mesh(Vector3d::Constant(edge));
  std::vector<Broken> all;
  const auto add = [&](const std::string& what, geometry::TriangleMesh mesh) {
    all.push_back({what, mesh_of(std::move(mesh))});
  };
  geometry::TriangleMesh mesh = good;
  mesh.triangles.resize(1);
  add("one triangle", mesh);
  mesh.triangles = {good.triangles[0],
                    Eigen::Vector3i(good.triangles[0][1], good.triangles[0][0], good.triangles[0][2])};
  add("two triangles back to back", mesh);
  mesh = good;
  mesh.triangles.resize(10);
  add("an open box", mesh);
  mesh = good;
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  add("a triangle turned round", mesh);
  mesh = good;
  for (Eigen::Vector3i& t : mesh.triangles) std::swap(t[0], t[1]);
  add("all turned inside out", mesh);
  mesh = good;
  mesh.triangles.insert(mesh.triangles.end(), good.triangles.begin(), good.triangles.end());
  add("every triangle twice", mesh);
  // Two boxes that share an edge: four triangles meet there.
  mesh = good;
  for (const Eigen::Vector3i& t : good.triangles) mesh.triangles.push_back(t + Eigen::Vector3i::Constant(8));
  for (const Vector3d& v : good.vertices) mesh.vertices.push_back(v + Vector3d(edge, edge, 0.0));
  for (Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 8; ++i) {
        if (mesh.vertices[static_cast<std::size_t>(t[k])] == mesh.vertices[static_cast<std::size_t>(i)]) t[k] = i;
      }
    }
  }
  add("an edge of four triangles", mesh);
  mesh = good;
  mesh.vertices[0] = mesh.vertices[1] + Vector3d(1e-13, 0, 0);
  add("slivers", mesh);
  // A strip with a half turn has one side.
  mesh = geometry::TriangleMesh();
  constexpr int around = 16;
  for (int i = 0; i < around; ++i) {
    const double u = 2.0 * M_PI * i / around;
    const Vector3d across(std::cos(u / 2) * std::cos(u), std::cos(u / 2) * std::sin(u), std::sin(u / 2));
    for (const double side : {-0.3, 0.3})
      mesh.vertices.push_back(0.5 * edge * (Vector3d(std::cos(u), std::sin(u), 0) + side * across));
  }
  for (int i = 0; i < around; ++i) {
    const int a = 2 * i, b = 2 * i + 1, c = i + 1 < around ? a + 2 : 1, d = i + 1 < around ? b + 2 : 0;
    test_support::add_quad(mesh, a, c, d, b);
  }
  add("a strip with a half turn", mesh);
  return all;
}

std::vector<geometry::Geometry> others() {
  return {geometry::Box{Vector3d::Constant(edge)}, geometry::Sphere{0.5 * edge},
          geometry::Cylinder{0.4 * edge, 2.0 * edge}, geometry::Cylinder{0.4 * edge, 20.0 * edge},
          sphere_mesh(0.5 * edge, 6)};
}

TEST(BrokenMeshes, ContactsAreFewAndFinite) {
  Random random(81);
  for (const Broken& broken : broken_meshes()) {
    for (const geometry::Geometry& other : others()) {
      scene::Scene scene;
      scene.bodies.resize(2);
      scene.bodies[0].movable = true;
      scene.bodies[0].collision = {geometry::Shape{broken.mesh}};
      scene.bodies[1].collision = {geometry::Shape{other}};
      const auto opened = contact::open_collision_world(scene);
      const collision::CollisionWorld& world = *opened;
      for (int i = 0; i < 60; ++i) {
        const RigidTransform X0 = random.pose(1.2 * edge), X1 = random.pose(1.2 * edge);
        std::vector<collision::ContactPoint> found;
        world.find_contacts(0, X0, 0.0, found);
        EXPECT_LT(found.size(), 500u) << broken.what;
        for (const collision::ContactPoint& c : found) {
          ASSERT_TRUE(c.p_W.allFinite() && std::isfinite(c.depth)) << broken.what << " and " << other.index();
          EXPECT_NEAR(c.n_W.norm(), 1.0, 1e-9) << broken.what << " and " << other.index();
          EXPECT_LT(c.depth, 25.0 * edge) << broken.what;  // the longest shape has 20
        }
        const collision::SweepResult path = world.sweep(0, X0, X1, 1e-6, 1e-3, i % 9);
        EXPECT_TRUE(path.free_fraction >= 0.0 && path.free_fraction <= path.touching_fraction &&
                    path.touching_fraction <= 1.0);
      }
    }
  }
}

/// Pushed down onto the bench, along a wall, and lifted again: whatever touches, the object finally follows the hand.
TEST(BrokenMeshes, HeldAndPressedTheyStayBoundedAndComeFree) {
  for (const Broken& broken : broken_meshes()) {
    for (const geometry::Geometry& wall : {geometry::Geometry(geometry::Box{Vector3d(0.1, 1.0, 1.0)}),
                                           geometry::Geometry(geometry::Cylinder{0.05, 2.0})}) {
      scene::Body body = box("held", Vector3d::Constant(edge), 0.2, Vector3d(0, 0, 0.1));
      body.collision = {geometry::Shape{broken.mesh}};
      scene::Body other = box("wall", Vector3d::Ones(), 0.0, Vector3d(0.15, 0, 0.5));
      other.collision = {geometry::Shape{wall}};
      SimulationSettings set;
      set.grasp.object = "held";
      Simulation s(scene_of({body, other}, scene::ContactMode::stop), set);
      const Vector3d start(0, 0, 0.1 + set.fork.length);
      push_move(s, 0.0, 0.4, start, start + Vector3d(0.1, 0.02, -0.08), 0.5);
      push_move(s, 0.42, 0.8, start + Vector3d(0.1, 0.02, -0.08), start + Vector3d(0, 0, 0.1));
      push_move(s, 0.82, 2.0, start + Vector3d(0, 0, 0.1), start + Vector3d(0, 0, 0.1));
      for (int i = 1; i <= 100; ++i) {
        EXPECT_EQ(s.advance_to(0.02 * i).steps_rejected, 0) << broken.what;
        const bodies::BodyState& o = s.objects()[0];
        ASSERT_TRUE(o.X_WO.matrix().allFinite() && o.V_WO_W.linear.allFinite()) << broken.what;
        EXPECT_LT(o.X_WO.translation().norm(), 0.5) << broken.what;
      }
      EXPECT_LT((s.objects()[0].X_WO.translation() - Vector3d(0, 0, 0.2)).norm(), 0.01)
          << broken.what << " " << wall.index();
    }
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::broken_meshes_test
