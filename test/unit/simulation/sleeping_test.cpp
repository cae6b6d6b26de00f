// What sleeps is there for others, and wakes if what it lies on goes.
#include <gtest/gtest.h>

#include <string>

#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation::sleeping_test {
namespace {

const Vector3d above(0.0, 0.0, 0.22);  // the tip of a 0.2 m fork is in the middle of the lower box on the bench

/// A box of 4 cm on the bench, and smaller ones beside it.
scene::Scene boxes(scene::ContactMode contact) {
  return scene_of(
      {box("lower", {0.1, 0.1, 0.04}, 1.0, {0.0, 0.0, 0.02}), box("upper", {0.04, 0.04, 0.04}, 0.2, {-0.5, 0.0, 0.02}),
       box("other", {0.04, 0.04, 0.04}, 0.2, {0.5, 0.0, 0.02})},
      contact);
}

void move(Simulation& simulation, const std::string& name, const Vector3d& p) {
  ObjectEdit edit;
  edit.action = ObjectEdit::Action::move;
  edit.name = name;
  edit.X_WL = make_transform(p, Quaterniond::Identity());
  simulation.edit(edit);
}

double height(const Simulation& simulation, const std::string& name) {
  return object(simulation, name).X_WO.translation().z();
}

/// `lower` held at rest 0.2 m above the bench until it sleeps, at 6 s; then `upper` falls on it from `above_it` [m].
Simulation held_asleep(scene::ContactMode contact, double above_it) {
  Simulation simulation(boxes(contact), SimulationSettings());
  simulation.push_stylus({0.0, pointing_down(above)});
  push_move(simulation, 0.02, 1.0, above, above + Vector3d(0.0, 0.0, 0.2));
  simulation.push_button(0.0, true);
  simulation.advance_to(6.0);
  EXPECT_TRUE(object(simulation, "lower").held && object(simulation, "lower").asleep);
  move(simulation, "upper", object(simulation, "lower").X_WO.translation() + Vector3d(0.0, 0.0, 0.04 + above_it));
  simulation.advance_to(9.0);
  return simulation;
}

class Sleeping : public testing::TestWithParam<scene::ContactMode> {};

TEST_P(Sleeping, AHeldSleeperCatchesWhatFallsOnIt) {
  const Simulation simulation = held_asleep(GetParam(), 0.05);
  EXPECT_NEAR(height(simulation, "upper") - height(simulation, "lower"), 0.04, 1e-3);
  EXPECT_GT(height(simulation, "lower"), 0.2);
}

TEST_P(Sleeping, WhatLiesOnAHeldSleeperFallsWhenThatIsLetGo) {
  for (const bool by_button : {true, false}) {
    Simulation simulation = held_asleep(GetParam(), 1e-4);
    ASSERT_GT(height(simulation, "upper"), 0.2);
    by_button ? simulation.push_button(9.0, false) : static_cast<void>(simulation.release());
    simulation.advance_to(12.0);
    EXPECT_LT(height(simulation, "upper"), 0.1) << by_button;
  }
}

TEST_P(Sleeping, WhatLiesOnASleeperFallsWhenThatIsPlacedElsewhere) {
  Simulation simulation(boxes(GetParam()), SimulationSettings());
  simulation.push_stylus({0.0, pointing_down({0.0, 0.0, 1.0})});
  simulation.advance_to(0.1);
  move(simulation, "upper", {0.0, 0.0, 0.0601});
  simulation.advance_to(4.0);
  ASSERT_TRUE(object(simulation, "upper").asleep);
  simulation.place({{"lower", make_transform({-0.5, 0.0, 0.02}, Quaterniond::Identity())}});
  simulation.advance_to(8.0);
  EXPECT_NEAR(height(simulation, "upper"), 0.02, 2e-4);
}

TEST_P(Sleeping, WhatLiesOnAHeldSleeperFallsWhenTheHandIsElsewhereAfterAGap) {
  Simulation simulation = held_asleep(GetParam(), 1e-4);
  ASSERT_GT(height(simulation, "upper"), 0.2);
  simulation.push_stylus({9.02, pointing_down(above + Vector3d(0.4, 0.4, 0.3))});
  simulation.advance_to(12.0);
  EXPECT_LT(height(simulation, "upper"), 0.1);
}

TEST_P(Sleeping, WhatGetsAMassFallsAndWhatLosesItStops) {
  scene::Scene scene = boxes(GetParam());
  scene.bodies[2].X_WO.translation().z() = 0.5;
  Simulation simulation(scene, SimulationSettings());
  simulation.push_stylus({0.0, pointing_down({0.0, 0.0, 1.0})});
  const auto set_mass = [&](double mass) {
    ObjectEdit edit;
    edit.action = ObjectEdit::Action::mass;
    edit.name = "other";
    edit.mass = mass;
    simulation.edit(edit);
  };
  simulation.advance_to(0.1);
  set_mass(0.0);
  simulation.advance_to(1.0);
  EXPECT_EQ(object(simulation, "other").V_WO_W.linear.norm(), 0.0);
  EXPECT_GT(object(simulation, "other").X_WO.translation().z(), 0.4);
  set_mass(1.0);
  simulation.advance_to(3.0);
  EXPECT_NEAR(object(simulation, "other").X_WO.translation().z(), 0.02, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(, Sleeping, testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& info) { return info.param == scene::ContactMode::stop ? "stop" : "dynamic"; });

TEST(Buttons, ActAtTheirTimesInWhateverOrderTheyArePushed) {
  Simulation simulation(boxes(scene::ContactMode::stop), SimulationSettings());
  for (double t = 0.0; t < 3.0; t += 0.02) simulation.push_stylus({t, pointing_down(above)});
  simulation.push_button(2.0, false);
  simulation.push_clutch(1.0, false);
  simulation.push_button(0.2, true);
  simulation.push_clutch(0.5, true);
  simulation.advance_to(0.3);
  EXPECT_TRUE(object(simulation, "lower").held);
  simulation.advance_to(0.7);
  EXPECT_TRUE(simulation.tool().clutch);
  simulation.advance_to(1.5);
  EXPECT_FALSE(simulation.tool().clutch);
  EXPECT_TRUE(object(simulation, "lower").held);
  simulation.advance_to(2.1);
  EXPECT_FALSE(object(simulation, "lower").held);
}

}  // namespace
}  // namespace spring_workbench::simulation::sleeping_test
