#include "spring_workbench/rigid_bodies/rigid_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spring_workbench/geometry/surface.h"
#include "support/bodies.h"
#include "support/meshes.h"

namespace spring_workbench::rigid_bodies {
namespace {

constexpr double g = 9.81;

scene::Body sphere(const std::string& name, double radius, double mass, const Vector3d& p_WO, double friction,
                   double restitution) {
  scene::Body b = box(name, Vector3d::Ones(), mass, p_WO, friction);
  b.material.restitution = restitution;
  b.mass_properties.inertia_O = 0.4 * mass * radius * radius * Matrix3d::Identity();
  b.collision[0].geometry = geometry::Sphere{radius};
  return b;
}

Twist moving(const Vector3d& v) {
  Twist t;
  t.linear = v;
  return t;
}

/// Steps end where bodies begin to bounce.
void run(RigidWorld& world, double duration, double h = 1e-3) {
  std::vector<DrivenBody> none;
  const int steps = static_cast<int>(std::lround(duration / h));
  for (int i = 0; i < steps; ++i) {
    for (double left = h, step = h; left > 1e-12; step = left) {
      world.step(step, none);
      if (world.first_bounce() < step) {
        step = world.first_bounce();
        world.undo_step();
        world.step(step, none);
      }
      left -= step;
    }
  }
}

bool any_awake(const RigidWorld& world) {
  const std::vector<std::size_t>& near = world.bodies_near();
  return std::any_of(near.begin(), near.end(), [&](std::size_t body) { return world.awake(body); });
}

/// The body on a massless spring: quasi-static, so every result is known.
struct OnSpring {
  double stiffness;  // N/m, all directions; it does not turn
  Vector3d hand;
  DrivenBody driven;

  /// Moves the hand to `to` within `h` and carries the body along.
  void step(RigidWorld& world, const Vector3d& to, double h) {
    driven.displacement_W.linear = to - driven.X_WO.translation();
    driven.displacement_W.angular.setZero();
    driven.compliance.setZero();
    driven.compliance.topLeftCorner<3, 3>().diagonal().setConstant(1.0 / stiffness);
    std::vector<DrivenBody> all{driven};
    world.step(h, all);
    driven.contact_W = all[0].contact_W;
    driven.X_WO.translation() = to + driven.contact_W.force / stiffness;
    world.place(driven.body, driven.X_WO, Twist(), true);
    hand = to;
  }
};

/// A prism along y over a profile in x and z with a notch of 90° from z = 0.1 down to z = 0.
geometry::MeshPtr notched_block() {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  for (const double y : {-0.1, 0.1}) {
    for (const auto& [x, z] : {std::pair(-0.1, -0.02), {0.1, -0.02}, {0.1, 0.1}, {0.0, 0.0}, {-0.1, 0.1}}) {
      mesh->vertices.emplace_back(x, y, z);
    }
  }
  mesh->triangles = {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}, {5, 8, 6}, {6, 8, 7}, {5, 9, 8}};
  for (int i = 0; i < 5; ++i) {
    const int j = (i + 1) % 5;
    mesh->triangles.emplace_back(i, i + 5, j + 5);
    mesh->triangles.emplace_back(i, j + 5, j);
  }
  return mesh;
}

// All contacts of a pair of shapes, whichever way they push, stop it together.
TEST(RigidWorld, ABoxStopsInANotchWithBothItsFaces) {
  const RigidTransform X = make_transform(Vector3d(0.0, 0.0, 0.02 * std::sqrt(2.0) + 1e-5),
                                          Quaterniond(Eigen::AngleAxisd(0.25 * M_PI, Vector3d::UnitY())));
  scene::Body block = box("block", Vector3d::Ones(), 1.0, Vector3d::Zero(), 0.0);
  block.movable = false;
  block.collision[0].geometry = notched_block();
  scene::Body falling = box("falling", Vector3d(0.04, 0.04, 0.04), 1.0, X.translation(), 0.0);
  falling.X_WO = X;
  scene::Scene scene = scene_of({falling, block}, scene::ContactMode::dynamic);
  scene.bench_height = -1.0;
  const std::unique_ptr<RigidWorld> world = make_rigid_world(scene);
  world->place(0, X, moving(Vector3d(0.0, 0.0, -1.0)), true);
  for (int i = 0; i < 3; ++i) {
    run(*world, 1e-3);
    EXPECT_NEAR(world->pose(0).translation().z(), 0.02 * std::sqrt(2.0), 2e-6);
    EXPECT_NEAR(world->pose(0).translation().x(), 0.0, 2e-6);
    EXPECT_LT((world->pose(0).linear() - X.linear()).norm(), 1e-4);
  }
}

/// A flat box that is no box to the world.
geometry::MeshPtr hull(const Vector3d& size) { return geometry::make_surface(geometry::Box{size})->mesh; }

/// A box of 2 cm that stands on a fixed hull, its lower face at `z`.
scene::Scene on_hull(const Vector3d& size, double z) {
  scene::Body block = box("block", Vector3d::Ones(), 1.0, Vector3d(0.0, 0.0, -0.5 * size.z()), 0.3);
  block.movable = false;
  block.collision[0].geometry = hull(size);
  scene::Scene scene = scene_of({box("above", Vector3d::Constant(0.02), 0.1, Vector3d(0.0, 0.0, 0.01 + z), 0.3), block},
                                scene::ContactMode::dynamic);
  scene.bench_height = -1.0;
  return scene;
}

// Regression: contacts deeper than a millimetre used to be dropped, and the body fell through unreported.
TEST(RigidWorld, WhatOverlapsAtTheStartComesOutAndCounts) {
  for (const double depth : {1.5e-3, 5e-3}) {
    const scene::Scene scene = on_hull({0.1, 0.1, 0.1}, -depth);
    const std::unique_ptr<RigidWorld> world = make_rigid_world(scene);
    world->place(0, scene.bodies[0].X_WO, Twist(), true);
    run(*world, 1e-3);
    EXPECT_FALSE(world->solved()) << depth;
    run(*world, 0.1);
    EXPECT_TRUE(world->solved()) << depth;
    EXPECT_NEAR(world->pose(0).translation().z(), 0.01, 1e-6) << depth;
    EXPECT_LT(world->velocity(0).linear.norm(), 1e-2) << depth;
  }
}

TEST(RigidWorld, APointBeyondAThinPartReturnsToItsEntry) {
  const scene::Scene scene = on_hull({0.1, 0.1, 5e-4}, 1e-5);
  const std::unique_ptr<RigidWorld> world = make_rigid_world(scene);
  world->place(0, scene.bodies[0].X_WO, Twist(), true);
  run(*world, 0.02);
  RigidTransform X = world->pose(0);
  EXPECT_TRUE(world->solved());
  X.translation().z() -= 2e-3;
  world->place(0, X, Twist(), true);
  run(*world, 1e-3);
  EXPECT_FALSE(world->solved());
  run(*world, 0.1);
  EXPECT_TRUE(world->solved());
  EXPECT_NEAR(world->pose(0).translation().z(), 0.01, 1e-6);
}

TEST(RigidWorld, SleepersCostNothingAndStay) {
  std::vector<scene::Body> bodies;
  for (int i = 0; i < 1000; ++i) {
    bodies.push_back(box("b" + std::to_string(i), Vector3d(0.04, 0.04, 0.04), 0.1, Vector3d(0.1 * i, 0.0, 0.02)));
  }
  const std::unique_ptr<RigidWorld> owner = make_rigid_world(scene_of(bodies, scene::ContactMode::dynamic));
  RigidWorld& world = *owner;
  run(world, 0.1);
  EXPECT_EQ(world.bodies_near().size(), 0u);
  EXPECT_FALSE(any_awake(world));
  world.place(500, world.pose(500), moving({0.0, 0.5, 0.0}), true);
  run(world, 0.05);
  EXPECT_LE(world.bodies_near().size(), 3u);
  EXPECT_EQ(world.pose(0).translation(), bodies[0].X_WO.translation());
  run(world, 3.0, 2e-3);
  EXPECT_FALSE(any_awake(world));
  EXPECT_EQ(world.bodies_near().size(), 0u);
}

TEST(RigidWorld, SlidingBoxStopsWhereItMust) {
  for (const double mu : {0.2, 0.5, 1.0}) {
    const std::unique_ptr<RigidWorld> owner = make_rigid_world(
        scene_of({box("b", Vector3d(0.1, 0.1, 0.02), 2.0, Vector3d(0, 0, 0.01), mu)}, scene::ContactMode::dynamic, mu));
    RigidWorld& world = *owner;
    const double v = 1.0;
    world.place(0, world.pose(0), moving({v, 0.0, 0.0}), true);
    run(world, 1.0);
    const double path = v * v / (2.0 * mu * g);
    EXPECT_NEAR(world.pose(0).translation().x(), path, 0.01 * path) << mu;
    EXPECT_NEAR(world.pose(0).translation().z(), 0.01, 1e-5);
    EXPECT_NEAR(world.pose(0).translation().y(), 0.0, 1e-3 * path);
  }
}

TEST(RigidWorld, InclineHoldsBelowTheAngleOfFriction) {
  const double mu = 0.5;
  for (const double off : {-0.1, 0.1}) {
    const double angle = std::atan(mu) + off * M_PI / 180.0;
    const Eigen::AngleAxisd tilt(angle, Vector3d::UnitY());  // downhill is +x
    scene::Body ramp = box("ramp", Vector3d(4.0, 1.0, 0.2), 0.0, Vector3d(0, 0, 3.0), mu);
    ramp.X_WO.linear() = tilt.toRotationMatrix();
    scene::Body b = box("b", Vector3d(0.1, 0.1, 0.05), 1.0, Vector3d::Zero(), mu);
    b.X_WO.linear() = tilt.toRotationMatrix();
    b.X_WO.translation() = ramp.X_WO * Vector3d(0, 0, 0.1 + 0.025);
    const std::unique_ptr<RigidWorld> owner = make_rigid_world(scene_of({ramp, b}, scene::ContactMode::dynamic, mu));
    RigidWorld& world = *owner;
    world.place(1, b.X_WO, Twist(), true);
    run(world, 10.0, 2e-3);
    const double slid = (world.pose(1).translation() - b.X_WO.translation()).norm();
    if (off < 0.0) {
      EXPECT_LT(slid, 1e-4);
    } else {
      // a = g (sin − μ cos)
      const double a = g * (std::sin(angle) - mu * std::cos(angle));
      EXPECT_NEAR(slid, 0.5 * a * 100.0, 0.05 * 0.5 * a * 100.0);
    }
  }
}

TEST(RigidWorld, WhatPassesAMillimetreBesideAnEdgeIsNotFelt) {
  for (const double radius : {0.005, 0.02, 0.1}) {
    for (const geometry::Geometry& shape :
         {geometry::Geometry(geometry::Sphere{radius}), geometry::Geometry(test_support::sphere_mesh(radius, 10)),
          geometry::Geometry(geometry::Cylinder{radius, 2.0 * radius})}) {
      for (int i = 0; i < 24; ++i) {  // where it is when a step begins
        scene::Body passes =
            sphere("passes", radius, 0.1, Vector3d(0.051 + radius, 0, 1.07 + radius + 1.6e-4 * i), 0.3, 0.0);
        passes.collision[0].geometry = shape;
        scene::Scene s = scene_of({box("box", Vector3d::Constant(0.1), 1.0, Vector3d(0, 0, 1), 0.3), passes},
                                  scene::ContactMode::dynamic, 0.3);
        s.gravity = 0.0;
        const auto world = make_rigid_world(s);
        world->place(0, s.bodies[0].X_WO, Twist(), true);
        world->place(1, passes.X_WO, moving(Vector3d(0, 0, -1.92)), true);
        run(*world, 0.15 + 2.0 * radius, 2e-3);
        EXPECT_LT(world->pose(1).translation().z(), 0.95 - radius);
        EXPECT_LT((world->velocity(1).linear - Vector3d(0, 0, -1.92)).norm(), 1e-12) << radius << ' ' << shape.index();
        EXPECT_EQ(world->velocity(0).linear.norm(), 0.0);
      }
    }
  }
}

TEST(RigidWorld, SphereRollsAtFiveSeventhsOfItsSpeed) {
  const std::unique_ptr<RigidWorld> owner = make_rigid_world(
      scene_of({sphere("s", 0.05, 1.0, Vector3d(0, 0, 0.05), 0.4, 0.0)}, scene::ContactMode::dynamic, 0.4));
  RigidWorld& world = *owner;
  world.place(0, world.pose(0), moving({2.0, 0.0, 0.0}), true);
  run(world, 1.0);
  EXPECT_NEAR(world.velocity(0).linear.x(), 2.0 * 5.0 / 7.0, 0.01 * 2.0);
  EXPECT_NEAR(world.velocity(0).angular.y() * 0.05, world.velocity(0).linear.x(), 5e-3);  // contact_skin / radius
}

TEST(RigidWorld, BallBouncesToTheSquareOfItsRestitution) {
  scene::Scene s = scene_of({sphere("s", 0.05, 1.0, Vector3d(0, 0, 1.05), 0.0, 0.8)}, scene::ContactMode::dynamic, 0.0);
  s.bench_material.restitution = 0.8;
  const std::unique_ptr<RigidWorld> owner = make_rigid_world(s);
  RigidWorld& world = *owner;
  world.place(0, world.pose(0), Twist(), true);
  const double fall = std::sqrt(2.0 / g);
  run(world, fall + 0.8 * fall, 5e-4);  // the highest point after the first bounce
  EXPECT_NEAR(world.pose(0).translation().z() - 0.05, 0.64, 1e-5);
}

// A rod that lands on an edge, in the plane: the impulse (x, z) that ends the motion of the edge; then, of it, a share
// along z, and what along x keeps the edge from slipping.
TEST(RigidWorld, ARodThatBouncesOnAnEdgeKeepsPoissonsLaw) {
  const double restitution = 0.5, tilt = 0.6, height = 1.5e-3;
  const Vector3d size(0.3, 0.02, 0.02), v0(0.3, 0.0, -1.0);
  scene::Body rod = box("rod", size, 0.5, Vector3d::Zero(), 10.0);
  rod.material.restitution = restitution;
  rod.X_WO.linear() = Eigen::AngleAxisd(tilt, Vector3d::UnitY()).toRotationMatrix();
  const Vector3d lever = rod.X_WO.linear() * Vector3d(0.5 * size.x(), 0.0, -0.5 * size.z());
  rod.X_WO.translation().z() = height - lever.z();
  scene::Scene s = scene_of({rod}, scene::ContactMode::dynamic, 10.0);
  s.bench_material.restitution = restitution;
  s.gravity = 0.0;
  const std::unique_ptr<RigidWorld> owner = make_rigid_world(s);
  RigidWorld& world = *owner;
  world.place(0, world.pose(0), moving(v0), true);
  run(world, 5e-3);  // it comes down in the second step

  const double m = rod.mass_properties.mass, I = rod.mass_properties.inertia_O(1, 1);
  const Eigen::Vector2d turns(lever.z(), -lever.x());  // spin about y by an impulse, times I
  const Eigen::Matrix2d W = Eigen::Matrix2d::Identity() / m + turns * turns.transpose() / I;
  const Eigen::Vector2d stops = -(W.inverse() * Eigen::Vector2d(v0.x(), v0.z()));
  const double back = restitution * stops[1];
  const Eigen::Vector2d impulse = stops + back * Eigen::Vector2d(-W(0, 1) / W(0, 0), 1.0);
  EXPECT_NEAR(world.velocity(0).linear.x(), v0.x() + impulse[0] / m, 5e-3);
  EXPECT_NEAR(world.velocity(0).linear.z(), v0.z() + impulse[1] / m, 5e-3);
  EXPECT_NEAR(world.velocity(0).angular.y(), turns.dot(impulse) / I, 0.05);
}

TEST(RigidWorld, AWayEndsWhereItTouches) {
  const std::unique_ptr<RigidWorld> owner = make_rigid_world(scene_of(
      {box("b", Vector3d(0.1, 0.1, 0.1), 1.0, Vector3d(0, 0, 0.15)), box("wall", {0.001, 1, 1}, 0.0, {0.2505, 0, 0.5})},
      scene::ContactMode::dynamic));
  const RigidWorld& world = *owner;
  const auto to = [&](double x, double z) {
    RigidTransform X = world.pose(0);
    X.translation() += Vector3d(x, 0, z);
    return X;
  };
  EXPECT_NEAR(world.collision_free_fraction(0, world.pose(0), to(0, -0.2)), 0.5, 1e-9);
  EXPECT_NEAR(world.admissible_fraction(0, world.pose(0), to(0, -0.2)), (0.1 + 5e-5) / 0.2, 1e-9);
  EXPECT_NEAR(world.admissible_fraction(0, to(0, -0.1), to(0, -0.3)), 5e-5 / 0.2, 1e-9);
  EXPECT_NEAR(world.collision_free_fraction(0, world.pose(0), to(0.8, 0)), 0.25, 1e-9);  // through a wall of 1 mm
  EXPECT_EQ(world.collision_free_fraction(0, world.pose(0), to(0.2, 0)), 1.0);
  EXPECT_EQ(world.collision_free_fraction(0, world.pose(0), to(-0.8, 0.5)), 1.0);
}

TEST(RigidWorld, StackOfTenStandsAndSleeps) {
  for (const double ratio : {1.0, 1000.0}) {  // the heaviest on top
    std::vector<scene::Body> bodies;
    for (int i = 0; i < 10; ++i) {
      const double mass = i == 9 ? ratio : 1.0;
      bodies.push_back(box("b" + std::to_string(i), Vector3d(0.1, 0.1, 0.05), mass, Vector3d(0, 0, 0.025 + 0.05 * i)));
    }
    const std::unique_ptr<RigidWorld> owner = make_rigid_world(scene_of(bodies, scene::ContactMode::dynamic));
    RigidWorld& world = *owner;
    world.place(0, world.pose(0), Twist(), true);
    run(world, 3.0, 2e-3);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      EXPECT_LT((world.pose(i).translation() - bodies[i].X_WO.translation()).norm(), 1e-4) << i << " " << ratio;
    }
    EXPECT_FALSE(any_awake(world));
  }
}

TEST(RigidWorld, PressedAndDraggedLagsByFrictionOverStiffness) {
  for (const double k : {2e1, 2e3, 2e9}) {
    for (const double mu : {0.0, 0.5, 1.0}) {
      const double h = 2e-3;
      const std::unique_ptr<RigidWorld> owner = make_rigid_world(scene_of(
          {box("b", Vector3d(0.2, 0.1, 0.05), 5.0, Vector3d(0, 0, 0.025), mu)}, scene::ContactMode::dynamic, mu));
      RigidWorld& world = *owner;
      OnSpring spring{k, Vector3d(0, 0, 0.025), {}};
      spring.driven.X_WO.translation() = spring.hand;
      for (int i = 1; i <= 50; ++i) spring.step(world, Vector3d(0, 0, 0.025 - 0.1 * i / 50), h);
      for (int i = 1; i <= 500; ++i) spring.step(world, Vector3d(0.001 * i, 0, -0.075), h);
      const double lag = spring.hand.x() - spring.driven.X_WO.translation().x();
      EXPECT_NEAR(lag, mu * 0.1, 1e-3 * 0.1) << k << " " << mu;
      EXPECT_NEAR(spring.driven.X_WO.translation().z(), 0.025, 1e-5) << k << " " << mu;
    }
  }
}

TEST(RigidWorld, ADrivenBodyMakesRoomForALightOneThatComesOutOfTheBench) {
  for (const double k : {1e3, 1e6, 1e9}) {
    const double deep = 9e-5, h = 1e-3;
    const scene::Body light = box("light", Vector3d::Constant(0.1), 1e-3, Vector3d(0, 0, 0.05 - deep));
    const scene::Body held = box("held", Vector3d::Constant(0.1), 1.0, Vector3d(0, 0, 0.15 - deep));
    const std::unique_ptr<RigidWorld> owner = make_rigid_world(scene_of({held, light}, scene::ContactMode::dynamic));
    RigidWorld& world = *owner;
    OnSpring spring{k, Vector3d(0, 0, 0.12), {}};
    spring.driven.X_WO.translation() = held.X_WO.translation();
    double overlap = 0.0;  // in any step: it comes out with the light one, not after it
    for (int i = 0; i < 100; ++i) {
      spring.step(world, spring.hand, h);
      const double apart = spring.driven.X_WO.translation().z() - world.pose(1).translation().z();
      overlap = std::max(overlap, 0.1 - apart);
    }
    EXPECT_LT(overlap, 1e-6) << k;
    EXPECT_NEAR(spring.driven.X_WO.translation().z(), 0.15, 5e-6) << k;
    EXPECT_NEAR(world.pose(1).translation().z(), 0.05, 5e-6) << k;
  }
}

TEST(RigidWorld, DrivenBodyPushesANeighbourAndCarriesAnother) {
  // A tray on a stiff spring is lifted with a cup on it; then it pushes a block along the bench.
  scene::Body tray = box("tray", Vector3d(0.2, 0.2, 0.02), 1.0, Vector3d(0, 0, 0.01));
  scene::Body cup = box("cup", Vector3d(0.05, 0.05, 0.05), 0.2, Vector3d(0, 0, 0.045));
  scene::Body block = box("block", Vector3d(0.1, 0.1, 0.1), 1.0, Vector3d(0.3, 0, 0.05));
  const std::unique_ptr<RigidWorld> owner = make_rigid_world(scene_of({tray, cup, block}, scene::ContactMode::dynamic));
  RigidWorld& world = *owner;
  OnSpring spring{1e5, Vector3d(0, 0, 0.01), {}};
  spring.driven.X_WO.translation() = spring.hand;
  const double h = 2e-3;
  for (int i = 1; i <= 500; ++i) spring.step(world, Vector3d(0, 0, 0.01 + 0.1 * i / 500), h);
  for (int i = 1; i <= 250; ++i) spring.step(world, spring.hand, h);
  EXPECT_NEAR(world.pose(1).translation().z(), 0.145 - 0.2 * g / 1e5, 1e-4);
  EXPECT_NEAR(spring.driven.contact_W.force.z(), -0.2 * g, 0.02 * 0.2 * g);
  for (int i = 1; i <= 500; ++i) spring.step(world, Vector3d(0, 0, 0.11 - 0.08 * i / 500), h);
  for (int i = 1; i <= 500; ++i) spring.step(world, Vector3d(0.2 * i / 500, 0, 0.03), h);
  EXPECT_NEAR(world.pose(2).translation().x(), spring.driven.X_WO.translation().x() + 0.15, 2e-3);
}

}  // namespace
}  // namespace spring_workbench::rigid_bodies
