#include <gtest/gtest.h>

#include "spring_workbench/live/simulation_runner.h"
#include "support/paths.h"

namespace spring_workbench::live::another_scene_test {
namespace {

scene::Scene shipped(const std::string& name) {
  return scene::load_scene(test_support::checkout("scenes/" + name + ".urdf"));
}

/// With `calibrate: world` another scene has another fork; switched DOFs are kept.
TEST(SimulationRunner, AnotherSceneHasAForkOfItsOwn) {
  simulation::SimulationSettings settings;
  settings.grasp.calibrate = tools::Calibration::world;
  SimulationRunner runner(shipped("single_box"), settings, hand_input::InputSettings(), false);
  Command stiff;
  stiff.kind = Command::Kind::settings;
  stiff.fork_change.dofs = {true, true, false};
  runner.change("stiff", stiff);
  runner.load(shipped("heavy"));
  const rod::ForkSettings fork = runner.locked([](const auto& s) { return s.fork_settings(1); });
  const simulation::Simulation alone(shipped("heavy"), settings);
  EXPECT_EQ(fork.stiffness, alone.fork_settings(1).stiffness);
  EXPECT_FALSE(fork.dofs.torsion);
}

}  // namespace
}  // namespace spring_workbench::live::another_scene_test
