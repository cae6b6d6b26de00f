// The tool spring_probe.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation {
namespace {

constexpr double g = 9.81;

SimulationSettings with_probe(double stiffness) {
  SimulationSettings set;
  set.tool = tools::Tool::spring_probe;
  set.fork.length = 0.2;
  set.fork.stiffness.stretch = stiffness;
  return set;
}

/// A fixed block whose top is at 0.1 m, pressed from above by `depth`.
tools::ToolState pressed(double material, double probe, double depth) {
  scene::Scene scene = scene_of({box("block", {0.2, 0.2, 0.1}, 0.0, Vector3d(0, 0, 0.05))}, scene::ContactMode::stop);
  scene.bodies[0].material.stiffness = material;
  Simulation simulation(scene, with_probe(probe));
  push_move(simulation, 0.0, 1.0, Vector3d(0, 0, 0.35), Vector3d(0, 0, 0.3 - depth));
  simulation.advance(2.0);
  return simulation.fork();
}

TEST(Probe, ReadsTheMaterialStiffnessInSeriesWithItsOwn) {
  for (const double material : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    for (const double probe : {100.0, 2000.0}) {
      const double depth = 0.03;
      const tools::ToolState tool = pressed(material, probe, depth);
      EXPECT_EQ(tool.touched, "block");
      EXPECT_EQ(tool.held_object, "");
      EXPECT_NEAR(tool.material_stiffness, material, 0.01 * material) << probe;
      const double force = depth / (1.0 / material + 1.0 / probe);
      EXPECT_NEAR(tool.handle_wrench_H.force.z(), -force, 1e-6 * force);
      EXPECT_NEAR(tool.stretch, -force / probe, 1e-6 * depth);
      // A given error of the tip's position means as much more as the material is stiffer than the pressing force
      // shows.
      EXPECT_NEAR(tool.material_stiffness_uncertainty, 1e-4 * material * material / force,
                  0.03 * 1e-4 * material * material / force);
    }
  }
}

TEST(Probe, ReadsRigidAsInfiniteAndTheAirAsNothing) {
  EXPECT_EQ(pressed(std::numeric_limits<double>::infinity(), 2000.0, 0.03).material_stiffness,
            std::numeric_limits<double>::infinity());
  const tools::ToolState air = pressed(1e4, 2000.0, -0.02);
  EXPECT_EQ(air.touched, "");
  EXPECT_EQ(air.material_stiffness, 0.0);
  EXPECT_EQ(air.handle_wrench_H.force.norm(), 0.0);
}

TEST(Probe, ReadsTheBench) {
  scene::Scene scene = scene_of({}, scene::ContactMode::none);
  scene.bench_material.stiffness = 5e3;
  Simulation simulation(scene, with_probe(1000.0));
  simulation.push_stylus({0.0, pointing_down({0.3, 0.0, 0.18})});
  simulation.advance(0.1);
  EXPECT_EQ(simulation.fork().touched, "workbench");
  EXPECT_NEAR(simulation.fork().material_stiffness, 5e3, 5.0);
}

/// The probe level, pointing along x.
RigidTransform level(const Vector3d& p) {
  return make_transform(Quaterniond(Eigen::AngleAxisd(0.5 * 3.14159265358979323846, Vector3d::UnitY())), p);
}

TEST(Probe, PushesABoxAlongTheBenchAgainstFriction) {
  for (const scene::ContactMode contact : {scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    const double mu = 0.4, probe = 500.0;
    Simulation simulation(scene_of({box("box", {0.1, 0.1, 0.06}, 1.0, Vector3d(0.15, 0, 0.03), mu)}, contact, mu),
                          with_probe(probe));
    for (double t = 0.0; t < 2.0; t += 0.02) simulation.push_stylus({t, level({-0.15 + 0.1 * t, 0.0, 0.02})});
    simulation.advance(1.8);
    const tools::ToolState tool = simulation.fork();
    EXPECT_EQ(tool.touched, "box");
    EXPECT_FALSE(simulation.objects()[0].held);
    // At constant speed the push is the friction, and the box is that much ahead of where the tip would be.
    EXPECT_NEAR(tool.tip_wrench_W.force.x(), mu * g, 0.02 * mu * g);
    EXPECT_NEAR(simulation.objects()[0].V_WO_W.linear.x(), 0.1, 2e-3);
    EXPECT_NEAR(simulation.objects()[0].X_WO.translation().x() - 0.05, -0.15 + 0.18 + 0.2 - mu * g / probe, 1e-3);
    // Drawn back, it leaves the box where it is.
    for (double t = 2.0; t < 3.0; t += 0.02) simulation.push_stylus({t, level({0.05 - 0.2 * (t - 2.0), 0.0, 0.02})});
    simulation.advance(3.0);
    EXPECT_EQ(simulation.fork().touched, "");
    EXPECT_LT(simulation.objects()[0].V_WO_W.linear.norm(), 1e-2);
  }
}

TEST(Probe, NoStiffnessMakesAPushBlowUp) {
  for (const double stiffness : {0.0, 1.0, 1e6, 1e12}) {
    for (const double material : {1e2, 1e6, std::numeric_limits<double>::infinity()}) {
      scene::Scene scene =
          scene_of({box("box", {0.1, 0.1, 0.06}, 0.1, Vector3d(0.15, 0, 0.5))}, scene::ContactMode::none);
      scene.bodies[0].material.stiffness = material;
      scene.gravity = 0.0;
      Simulation simulation(scene, with_probe(stiffness));
      for (double t = 0.0; t < 2.0; t += 0.02) simulation.push_stylus({t, level({-0.15 + 0.2 * t, 0.01, 0.5})});
      simulation.advance(1.9);
      const bodies::BodyState& o = simulation.objects()[0];
      ASSERT_TRUE(o.X_WO.matrix().allFinite()) << stiffness;
      EXPECT_LT(o.V_WO_W.linear.norm(), 1.0) << stiffness << " " << material;
    }
  }
}

TEST(Probe, CannotHold) {
  Simulation simulation(scene_of({box("box", {0.1, 0.1, 0.06}, 1.0, Vector3d(0, 0, 0.5))}, scene::ContactMode::none),
                        SimulationSettings());
  push_move(simulation, 0.0, 1.0, Vector3d(0, 0, 0.7), Vector3d(0.2, 0, 0.8));
  simulation.push_button(0.0, true);
  simulation.advance(0.5);
  ASSERT_EQ(simulation.fork().held_object, "box");
  const bodies::BodyState before = simulation.objects()[0];
  EXPECT_NE(simulation.select_tool(tools::Tool::spring_probe).message.find("released"), std::string::npos);
  EXPECT_FALSE(simulation.objects()[0].held);
  EXPECT_LT((simulation.objects()[0].V_WO_W.linear - before.V_WO_W.linear).norm(), 1e-12);
}

}  // namespace
}  // namespace spring_workbench::simulation
