#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"
#include "support/random_poses.h"

namespace spring_workbench::simulation::breakaway_test {
namespace {

using test_support::Random;

constexpr double gravity = 9.81;
const Vector3d above(0.0, 0.0, 0.22);  // the tip of a 0.2 m fork is in the middle of a box on the bench

scene::Scene one_box(double mass, scene::ContactMode contact) {
  return scene_of({box("box", {0.1, 0.06, 0.04}, mass, {0.0, 0.0, 0.02}, 0.5)}, contact, 0.5);
}

SimulationSettings breaking_at(double force, double moment = std::numeric_limits<double>::infinity()) {
  SimulationSettings set;
  set.limit.force = force;
  set.limit.moment = moment;
  return set;
}

class Breakaway : public testing::TestWithParam<scene::ContactMode> {};

TEST_P(Breakaway, WhatIsTooHeavyIsNotLiftedAndWhatIsNotIs) {
  for (const double share : {0.9, 1.2}) {
    Simulation simulation(one_box(1.0, GetParam()), breaking_at(share * gravity));
    push_move(simulation, 0.0, 3.0, above, above + Vector3d(0.0, 0.0, 0.2));
    simulation.push_button(0.0, true);
    for (int i = 1; i <= 150; ++i) {
      simulation.advance_to(0.02 * i);
      EXPECT_LE(simulation.tool().tip_wrench_W.force.norm(), share * gravity);
    }
    const bodies::BodyState& box = simulation.objects()[0];
    EXPECT_EQ(box.held, share > 1.0);
    if (box.held) {
      EXPECT_NEAR(box.X_WO.translation().z(), 0.22 - gravity / 2000.0, 1e-3);
    } else {
      EXPECT_NEAR(box.X_WO.translation().z(), 0.02, 1e-4);
    }
  }
}

TEST_P(Breakaway, PressingBeyondTheLimitReleases) {
  Simulation simulation(one_box(1.0, GetParam()), breaking_at(30.0));
  push_move(simulation, 0.0, 1.0, above, above - Vector3d(0.0, 0.0, 0.04));  // 2000 N/m: 80 N
  simulation.push_button(0.0, true);
  for (int i = 1; i <= 50; ++i) {
    simulation.advance_to(0.02 * i);
    EXPECT_LE(simulation.tool().tip_wrench_W.force.norm(), 30.0);
  }
  EXPECT_FALSE(simulation.objects()[0].held);
}

INSTANTIATE_TEST_SUITE_P(Contacts, Breakaway, testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& tested) {
                           return tested.param == scene::ContactMode::stop ? "stop" : "dynamic";
                         });

TEST(BreakawayForce, AStiffForkDoesNotCarryAlongWhatIsTooHeavyForIt) {
  constexpr double mass = 1000.0, force = 100.0, time = 0.5;
  SimulationSettings set = breaking_at(force);
  set.gravity = 0.0;
  set.fork.stiffness = {1e9, 1e9, 1e9};
  Simulation simulation(one_box(mass, scene::ContactMode::none), set);
  push_move(simulation, 0.0, time, above, above + Vector3d(0.5, 0.0, 0.5));
  simulation.push_button(0.0, true);
  simulation.advance_to(time);
  const bodies::BodyState& box = simulation.objects()[0];
  EXPECT_FALSE(box.held);
  EXPECT_LE(box.V_WO_W.linear.norm(), force / mass * time);
}

TEST(BreakawayForce, NoWrenchIsLargerInAnyMotion) {
  Random random(4711);
  int broken = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const double force = std::pow(10.0, random.number(0.5, 2.5)), moment = std::pow(10.0, random.number(-1.0, 1.5));
    SimulationSettings set = breaking_at(force, moment);
    const double stiffer = std::pow(10.0, random.number(-1.0, 4.0));
    set.fork.stiffness = {2000.0 * stiffer, 500.0 * stiffer, 5.0 * stiffer};
    Simulation simulation(one_box(1.0, scene::ContactMode::none), set);
    RigidTransform X = pointing_down(above);
    simulation.push_stylus({0.0, X});
    simulation.push_button(0.0, true);
    for (int i = 1; i <= 50; ++i) {
      X = make_transform(X.translation() + random.vector(0.02),
                         Quaterniond(math::exp_so3(random.vector(0.1)) * X.linear()));
      simulation.push_stylus({0.02 * i, X});
    }
    for (int i = 1; i <= 100; ++i) {
      simulation.advance_to(0.01 * i);
      const tools::ToolState fork = simulation.tool();
      EXPECT_LE(fork.tip_wrench_W.force.norm(), force) << trial;
      EXPECT_LE(fork.tip_wrench_W.moment.norm(), moment) << trial;
    }
    broken += simulation.objects()[0].held ? 0 : 1;
  }
  EXPECT_GT(broken, 10);
  EXPECT_LT(broken, 40);
}

}  // namespace
}  // namespace spring_workbench::simulation::breakaway_test
