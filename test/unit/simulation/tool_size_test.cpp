// The fork's size from the object's, at a grasp and while holding.
#include <gtest/gtest.h>

#include <cmath>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/tools/calibration.h"
#include "support/bench_scenes.h"
#include "support/named.h"

namespace spring_workbench::simulation::tool_size_test {
namespace {

constexpr double g = 9.81, reach = 0.2;
const Vector3d start(0.0, 0.0, 0.6);

SimulationSettings settings(bool calibrate) {
  SimulationSettings set;
  set.grasp.calibrate = calibrate ? tools::Calibration::object : tools::Calibration::none;
  return set;
}

scene::Scene one_box(const Vector3d& size, double mass) {
  return scene_of({box("box", size, mass, start)}, scene::ContactMode::none);
}

double fitting_length(const scene::Scene& scene) {
  const scene::MassProperties& m = scene.bodies[0].mass_properties;
  return tools::calibrated_length({m.mass, m.inertia_O, RigidTransform::Identity()});
}

/// By button, with the tip at `tip_O` in the box.
Simulation grasped(const scene::Scene& scene, const SimulationSettings& set, const Vector3d& tip_O) {
  Simulation simulation(scene, set);
  simulation.push_stylus({0.0, pointing_down(start + tip_O + Vector3d(0.0, 0.0, reach))});
  simulation.push_button(0.0, true);
  return simulation;
}

TEST(ToolSize, AGraspByButtonFitsTheForkToTheObjectAndMovesNothing) {
  for (const double scale : {0.2, 1.0, 4.0}) {
    for (const double mass : {1e-6, 1.0, 300.0, 1e6}) {
      for (const Vector3d& grasp : {Vector3d(0, 0, 0), Vector3d(0.045, 0, 0), Vector3d(0.045, 0.025, 0.015)}) {
        const Vector3d size = scale * Vector3d(0.1, 0.06, 0.04), tip = scale * grasp;
        const scene::Scene scene = one_box(size, mass);
        Simulation simulation = grasped(scene, settings(true), tip);
        simulation.advance_to(0.0);
        const tools::ToolState fork = simulation.tool();
        ASSERT_EQ(fork.held_object, "box");
        EXPECT_NEAR(fork.length, fitting_length(scene), 1e-12);
        EXPECT_LT((simulation.objects()[0].X_WO.translation() - start).norm(), 1e-12);
        EXPECT_LT((fork.X_WE.translation() - start - tip).norm(), 1e-12) << "the tip stays where it was put in";
        EXPECT_EQ(fork.strain.norm(), 0.0);
        EXPECT_NEAR(fork.X_WS.translation().z() - fork.X_WH.translation().z(), reach - fork.length, 1e-12);
        // Hanging at rest, straight under the hand: the static extension is the set part of the length.
        if (!grasp.isZero()) continue;
        simulation.advance_to(8.0);
        EXPECT_NEAR(simulation.tool().stretch, 0.1 * fork.length, 1e-3 * fork.length) << scale << ", " << mass;
      }
    }
  }
}

TEST(ToolSize, WithoutCalibrationTheForkKeepsItsLength) {
  Simulation simulation = grasped(one_box({0.1, 0.06, 0.04}, 1.0), settings(false), Vector3d::Zero());
  simulation.advance_to(0.0);
  EXPECT_EQ(simulation.tool().length, reach);
  EXPECT_TRUE(simulation.tool().X_WH.matrix() == simulation.tool().X_WS.matrix());
}

TEST(ToolSize, AfterTheReleaseTheHandReachesAsFarAsBefore) {
  Simulation simulation = grasped(one_box({0.2, 0.2, 0.2}, 1.0), settings(true), Vector3d::Zero());
  simulation.advance_to(0.0);
  EXPECT_GT(simulation.tool().length, 1.5 * reach);
  simulation.release();
  EXPECT_EQ(simulation.tool().length, reach);
  EXPECT_TRUE(simulation.tool().X_WH.matrix() == simulation.tool().X_WS.matrix());
}

/// The object hangs at rest on a fork of any stiffness: calibration gives it another size and stiffness, and it stays.
TEST(ToolSize, CalibratingWhileHoldingMovesNothingAtRest) {
  for (const std::string& shape : test_support::shape_names()) {
    for (const double soft : {0.7, 1.0, 100.0}) {
      for (const Vector3d& tip : {Vector3d(0, 0, 0), Vector3d(0.04, 0.02, 0)}) {
        SimulationSettings set = settings(false);
        set.fork.shape = test_support::shape_named(shape);
        set.fork.stiffness = {soft * 500.0, soft * 500.0, soft * 5.0};
        Simulation simulation = grasped(one_box({0.1, 0.06, 0.04}, 1.0), set, tip);
        simulation.advance_to(10.0);
        const bodies::BodyState before = simulation.objects()[0];
        const Vector3d force = simulation.tool().tip_wrench_W.force;
        simulation.calibrate();
        EXPECT_LT((simulation.objects()[0].X_WO.matrix() - before.X_WO.matrix()).norm(), 1e-12);
        EXPECT_LT((simulation.tool().tip_wrench_W.force - force).norm(), 1e-4 * force.norm()) << shape << soft;
        simulation.advance_to(12.0);
        EXPECT_LT((simulation.objects()[0].X_WO.matrix() - before.X_WO.matrix()).norm(), 1e-5) << shape << soft;
        const double sag = 0.1 * simulation.tool().length;
        if (tip.isZero()) {
          EXPECT_NEAR(simulation.tool().stretch, sag, 1e-5);
        }
      }
    }
  }
}

TEST(ToolSize, CalibratingInMotionJumpsNeitherInPoseNorInTwist) {
  for (const rod::ForkDofs& dofs :
       {rod::ForkDofs{true, true, true}, rod::ForkDofs{false, true, false}, rod::ForkDofs{false, false, false}}) {
    SimulationSettings set = settings(false);
    set.fork.dofs = dofs;
    Simulation simulation(one_box({0.1, 0.06, 0.04}, 1.0), set);
    const Vector3d from = start + Vector3d(0.03, 0.01, reach);
    push_move(simulation, 0.0, 1.0, from, from + Vector3d(0.3, 0.1, 0.2), 1.0);
    simulation.push_button(0.0, true);
    simulation.advance_to(0.5);
    const bodies::BodyState before = simulation.objects()[0];
    simulation.calibrate();
    constexpr double h = 1e-6;
    simulation.advance_to(0.5 + h);
    const bodies::BodyState& after = simulation.objects()[0];
    EXPECT_LT((after.X_WO.translation() - before.X_WO.translation() - h * before.V_WO_W.linear).norm(), 1e-9);
    EXPECT_LT((after.V_WO_W.linear - before.V_WO_W.linear).norm(), 1e-3);
    EXPECT_LT((after.V_WO_W.angular - before.V_WO_W.angular).norm(), 1e-2);
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::tool_size_test
