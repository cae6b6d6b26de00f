// One fork for all objects of a scene: lifting one after the other shows which is heavier.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/tools/calibration.h"
#include "support/bench_scenes.h"
#include "support/paths.h"

namespace spring_workbench::simulation::world_calibration_test {
namespace {

const std::string scenes = test_support::checkout("scenes/");
const Vector3d hanging(M_PI, 0.0, 0.0);       // z of the handle is down
const Vector3d level(0.0, -0.5 * M_PI, 0.0);  // x of the handle is up

SimulationSettings to_world() {
  SimulationSettings settings;
  settings.grasp.calibrate = tools::Calibration::world;
  return settings;
}

/// The tool with the object at rest on it, the tip at `tip_O` in the object.
tools::ToolState at_rest(const scene::Scene& scene, const std::string& name, const Vector3d& tip_O,
                         const Vector3d& turn) {
  SimulationSettings settings = to_world();
  settings.contact = scene::ContactMode::none;
  settings.grasp.object = name;
  settings.grasp.X_OE = make_transform(tip_O, Quaterniond::Identity());
  settings.grasp.start_follow = true;
  Simulation simulation(scene, settings);
  const RigidTransform hand = make_transform(Vector3d(0.0, 0.0, 1.0), Quaterniond(math::exp_so3(turn)));
  for (const double t : {0.0, 0.1}) simulation.push_stylus({t, hand});
  simulation.advance_to(6.0);
  return simulation.tool();
}

TEST(WorldCalibration, TheForkShowsTheWeightInEveryShippedScene) {
  int scenes_seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".urdf") continue;
    ++scenes_seen;
    const scene::Scene scene = scene::load_scene(entry.path().string());
    std::map<double, std::string> by_mass;
    for (const scene::Body& body : scene.bodies) {
      if (body.movable) by_mass[body.mass_properties.mass] = body.name;
    }
    const tools::WorldGoal goal;
    const tools::WorldLoad load = tools::world_load(scene, goal);
    const Vector3d beside(0.0, -load.lever, 0.0), centre = Vector3d::Zero();
    double before = 0.0, extends = 0.0, deflects = 0.0, twists = 0.0;
    for (const auto& [mass, name] : by_mass) {
      const double extension = at_rest(scene, name, centre, hanging).stretch;
      const double deflection = at_rest(scene, name, centre, level).bend.norm();
      const double twist = std::abs(at_rest(scene, name, beside, level).torsion);
      const double length = at_rest(scene, name, centre, hanging).length;
      if (before == 0.0) {
        extends = extension / mass;
        deflects = deflection / mass;
        twists = twist / mass;
      }
      EXPECT_GT(extension, before) << name;
      EXPECT_NEAR(extension, extends * mass, 0.01 * extends * mass) << name;
      before = extension;
      if (deflection < 0.1 * length) {
        EXPECT_NEAR(deflection, deflects * mass, 0.01 * deflects * mass) << name;
        EXPECT_NEAR(twist, twists * mass, 0.01 * twists * mass) << name;
      }
      if (mass == load.mass) {
        EXPECT_NEAR(extension, goal.stretch * length, 0.02 * goal.stretch * length) << name;
        EXPECT_NEAR(deflection, goal.bend * length, 0.02 * goal.bend * length) << name;
        EXPECT_NEAR(twist, goal.twist, 0.02 * goal.twist) << name;
      }
    }
  }
  EXPECT_GE(scenes_seen, 4);
}

/// The bar lies across the level fork, which has it 10 cm off its centre.
TEST(WorldCalibration, ABarTakenOffItsCentreBendsAndTwistsTheFork) {
  const scene::Scene scene = scene::load_scene(scenes + "bar.urdf");
  const Vector3d across(0.5 * M_PI, 0.0, 0.0);  // y of the handle is up
  const tools::ToolState off = at_rest(scene, "bar", Vector3d(0.1, 0.0, 0.0), across);
  EXPECT_GT(off.bend.norm(), 0.3 * off.length);
  EXPECT_GT(std::abs(off.torsion), 0.2);
  const tools::ToolState cube = at_rest(scene, "cube", Vector3d(0.01, 0.0, 0.0), across);
  EXPECT_GT(off.bend.norm(), 5.0 * cube.bend.norm());
  EXPECT_GT(std::abs(off.torsion), 50.0 * std::abs(cube.torsion));
}

TEST(WorldCalibration, ThreeHundredVirtualKilogramsAreLiftedByAPullOfFortyCentimetres) {
  const scene::Scene scene = scene::load_scene(scenes + "heavy.urdf");
  Simulation simulation(scene, to_world());
  const Vector3d from = object(simulation, "three_hundred").X_WO.translation() + Vector3d(0.0, 0.0, 0.2);
  push_move(simulation, 0.0, 1.5, from, from + Vector3d(0.0, 0.0, 0.4));
  simulation.push_button(0.0, true);
  int rejected = 0;
  for (double t = 0.02; t < 5.0; t += 0.02) rejected += simulation.advance_to(t).steps_rejected;
  EXPECT_NEAR(object(simulation, "three_hundred").X_WO.translation().z(), 0.04 + 0.4 - 0.3 * 0.2, 2e-3);
  EXPECT_NEAR(simulation.tool().stretch, 0.3 * 0.2, 1e-4);
  EXPECT_EQ(rejected, 0);
}

/// The fork stays the world's, whatever is grasped, until a hand's own is set; ~calibrate brings the world's back.
TEST(WorldCalibration, TheForkStaysAndComesBack) {
  const scene::Scene scene = scene::load_scene(scenes + "heavy.urdf");
  Simulation simulation(scene, to_world());
  const double stiffness = simulation.fork_settings().stiffness.stretch;
  const Vector3d from = object(simulation, "ten").X_WO.translation() + Vector3d(0.0, 0.0, 0.2);
  push_move(simulation, 0.0, 1.0, from, from + Vector3d(0.0, 0.0, 0.3));
  simulation.push_button(0.0, true);
  simulation.advance_to(4.0);
  EXPECT_EQ(simulation.fork_settings().stiffness.stretch, stiffness);
  EXPECT_NEAR(simulation.tool().stretch, 0.3 * 0.2 * 10.0 / 300.0, 1e-5);
  ForkChange change;
  change.stiffness.stretch = 0.5 * stiffness;
  simulation.change(change, {}, 0);
  const Vector3d before = object(simulation, "ten").X_WO.translation();
  simulation.calibrate();
  EXPECT_EQ(simulation.fork_settings().stiffness.stretch, stiffness);
  EXPECT_LT((object(simulation, "ten").X_WO.translation() - before).norm(), 1e-12);
}

TEST(WorldCalibration, AGivenRangeTakesThePlaceOfTheScenes) {
  const scene::Scene scene = scene::load_scene(scenes + "heavy.urdf");
  SimulationSettings settings = to_world();
  settings.grasp.world_goal.heaviest = 30.0;
  const double k = Simulation(scene, to_world()).fork_settings().stiffness.stretch;
  EXPECT_NEAR(Simulation(scene, settings).fork_settings().stiffness.stretch, 0.1 * k, 1e-9 * k);
}

}  // namespace
}  // namespace spring_workbench::simulation::world_calibration_test
