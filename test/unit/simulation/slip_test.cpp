// A tool that slips in the hand at its limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"
#include "support/named.h"

namespace spring_workbench::simulation::slip_test {
namespace {

constexpr double g = 9.81, limit = 30.0;
const Vector3d above(0.0, 0.0, 0.22);  // the tip of a 0.2 m fork is in the middle of a box on the bench

scene::Scene one_box(double mass, scene::ContactMode contact) {
  return scene_of({box("box", {0.1, 0.06, 0.04}, mass, {0.0, 0.0, 0.02}, 0.5)}, contact, 0.5);
}

SimulationSettings slipping_at(double force, tools::Tool tool = tools::Tool::spring_fork) {
  SimulationSettings set;
  set.tool = tool;
  set.limit.force = force;
  set.limit.action = tools::LimitAction::slip;
  return set;
}

double gap(const Simulation& simulation) {
  const tools::ToolState f = simulation.tool();
  return (f.X_WH.translation() - f.X_WH_proxy.translation()).norm();
}

class Slip : public testing::TestWithParam<scene::ContactMode> {};

/// A tool that pulls on a box of 5 kg: the hand moves up by 0.4 m, waits, and returns.
struct Pulled {
  double largest = 0.0, jump = 0.0;  ///< force, and its change over a step [N]
  double at_limit = 0.0;             ///< [s]
  double gap = 0.0, moved = 0.0;     ///< at the end [m]

  Pulled(scene::ContactMode contact, tools::Tool tool, double step) {
    SimulationSettings set = slipping_at(limit, tool);
    set.dynamics.step = step;
    Simulation simulation(one_box(5.0, contact), set);
    const Vector3d up = above + Vector3d(0.0, 0.0, 0.4);
    push_move(simulation, 0.0, 1.0, above, up);
    push_move(simulation, 1.02, 1.5, up, up);
    push_move(simulation, 1.52, 2.5, up, above);
    push_move(simulation, 2.52, 4.0, above, above);
    simulation.push_button(0.0, true);
    double before = 0.0;
    for (int i = 1; i * step < 4.0; ++i) {
      simulation.advance_to(i * step);
      EXPECT_TRUE(simulation.objects()[0].held) << i * step;
      const double force = simulation.tool().tip_wrench_W.force.norm();
      if (slip_test::gap(simulation) > 0.1) {  // nearer, it comes back faster than the hand does
        EXPECT_NEAR(force, limit, 0.01 * limit) << i * step;
        at_limit += step;
      }
      largest = std::max(largest, force);
      jump = std::max(jump, std::abs(force - before));
      before = force;
    }
    gap = slip_test::gap(simulation);
    moved = (simulation.objects()[0].X_WO.translation() - Vector3d(0.0, 0.0, 0.02)).norm();
  }
};

/// The box is too heavy. The force does not jump, neither where the tool begins to slip nor where it is with the hand
/// again: its largest change over a step goes to zero with the step.
TEST_P(Slip, WhatIsTooHeavyIsPulledWithTheLimitAndTheWrenchDoesNotJump) {
  for (const tools::Tool tool : {tools::Tool::spring_fork, tools::Tool::spring}) {
    double jump = 1e9;
    for (const double step : {0.02, 0.005, 0.00125}) {
      const Pulled pulled(GetParam(), tool, step);
      EXPECT_GT(pulled.at_limit, 1.0) << step;
      EXPECT_LT(pulled.largest, 1.01 * limit) << step;
      EXPECT_LT(pulled.gap, 1e-6) << step;
      EXPECT_LT(pulled.moved, 2e-3) << step;
      EXPECT_LT(pulled.jump, 0.35 * jump) << step;
      jump = pulled.jump;
    }
    EXPECT_LT(jump, 0.05 * limit);
  }
}

/// Lifted faster than the limit allows: it is pulled up with the limit force and reaches the hand.
TEST_P(Slip, TheToolReturnsToTheHand) {
  Simulation simulation(one_box(1.0, GetParam()), slipping_at(1.3 * g));
  push_move(simulation, 0.0, 0.4, above, above + Vector3d(0.0, 0.0, 0.3));
  push_move(simulation, 0.42, 6.0, above + Vector3d(0.0, 0.0, 0.3), above + Vector3d(0.0, 0.0, 0.3));
  simulation.push_button(0.0, true);
  double widest = 0.0;
  for (int i = 1; i <= 300; ++i) {
    simulation.advance_to(0.02 * i);
    EXPECT_LE(simulation.tool().tip_wrench_W.force.norm(), 1.01 * 1.3 * g);
    widest = std::max(widest, gap(simulation));
  }
  EXPECT_GT(widest, 0.05);
  EXPECT_EQ(gap(simulation), 0.0);
  EXPECT_TRUE(simulation.objects()[0].held);
  EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), 0.32 - g / 2000.0, 1e-6);
}

/// One of two tools pulls the plate up beyond its limit and comes back: it slips, and nobody lets go.
struct PulledByOneOfTwo {
  double at_limit = 0.0;  ///< [s]
  double jump = 0.0;      ///< change of the force of the first tool over a step [N]
  double gap = 0.0;       ///< at the end [m]

  PulledByOneOfTwo(scene::ContactMode contact, tools::Tool other, double step) {
    scene::Scene scene = scene_of({box("plate", {0.2, 0.2, 0.04}, 3.0, {0.0, 0.0, 0.5})}, contact);
    SimulationSettings set = slipping_at(25.0);
    set.dynamics.step = step;
    set.styluses = 2;
    Simulation simulation(scene, set);
    simulation.select_tool(other, 1);
    const Vector3d first(0.06, 0.0, 0.7), up = first + Vector3d(0.0, 0.0, 0.25);
    const Vector3d second(-0.06, 0.0, other == tools::Tool::direct ? 0.5 : 0.7);
    push_move(simulation, 0.0, 1.0, first, first);
    push_move(simulation, 1.02, 2.0, first, up);
    push_move(simulation, 2.02, 2.5, up, up);
    push_move(simulation, 2.52, 3.5, up, first);
    push_move(simulation, 3.52, 6.0, first, first);
    push_move(simulation, 0.0, 6.0, second, second, 0.0, 1);
    for (const std::size_t hand : {0u, 1u}) simulation.push_button(0.0, true, hand);
    double before = 0.0;
    for (int i = 1; i * step < 6.0; ++i) {
      simulation.advance_to(i * step);
      for (const std::size_t hand : {0u, 1u}) EXPECT_EQ(simulation.tool(hand).held_object, "plate") << i * step;
      const double force = simulation.tool().tip_wrench_W.force.norm();
      EXPECT_LT(force, 1.01 * 25.0) << i * step;
      if (slip_test::gap(simulation) > 0.05) {
        EXPECT_NEAR(force, 25.0, 0.01 * 25.0) << i * step;
        at_limit += step;
      }
      if (i * step > 0.5) jump = std::max(jump, std::abs(force - before));  // then the plate hangs
      before = force;
    }
    gap = slip_test::gap(simulation);
  }
};

TEST_P(Slip, OneOfTwoToolsSlipsWhileTheOtherHolds) {
  for (const tools::Tool other : {tools::Tool::spring_fork, tools::Tool::direct}) {
    double jump = 1e9;
    for (const double step : {0.005, 0.00125}) {
      const PulledByOneOfTwo pulled(GetParam(), other, step);
      EXPECT_GT(pulled.at_limit, 1.0) << step;
      EXPECT_LT(pulled.gap, 1e-6) << step;
      EXPECT_LT(pulled.jump, 0.35 * jump) << step;
      jump = pulled.jump;
    }
    EXPECT_LT(jump, 0.05 * 25.0);
  }
}

/// Tools that together cannot carry the plate: it falls as a body does that is pulled with all their limits.
TEST(SlipInTheAir, SeveralToolsSlipEachAtItsLimit) {
  for (const std::size_t tools : {2u, 3u}) {
    scene::Scene scene = scene_of({box("plate", {0.2, 0.2, 0.04}, 5.0, {0.0, 0.0, 0.5})}, scene::ContactMode::none);
    SimulationSettings set = slipping_at(12.0);
    set.styluses = static_cast<int>(tools);
    Simulation simulation(scene, set);
    for (std::size_t k = 0; k < tools; ++k) {
      const double angle = 2.0 * M_PI * static_cast<double>(k) / static_cast<double>(tools);
      const Vector3d hand(0.06 * std::cos(angle), 0.06 * std::sin(angle), 0.7);
      push_move(simulation, 0.0, 2.0, hand, hand, 0.0, k);
      simulation.push_button(0.0, true, k);
    }
    simulation.advance_to(0.6);
    const bodies::BodyState a = simulation.objects()[0];
    for (std::size_t k = 0; k < tools; ++k) {
      EXPECT_EQ(simulation.tool(k).held_object, "plate");
      EXPECT_NEAR(simulation.tool(k).tip_wrench_W.force.norm(), 12.0, 0.12);
    }
    simulation.advance_to(0.8);
    const double acceleration = static_cast<double>(tools) * 12.0 / 5.0 - g;
    EXPECT_NEAR(simulation.objects()[0].V_WO_W.linear.z() - a.V_WO_W.linear.z(), 0.2 * acceleration, 1e-3) << tools;
  }
}

/// In the air under the limit: the object falls as a body does that is pulled with it.
TEST(SlipInTheAir, TheObjectMovesAsNewtonSays) {
  scene::Scene scene = scene_of({box("box", {0.1, 0.06, 0.04}, 5.0, {0.0, 0.0, 0.5})}, scene::ContactMode::none);
  Simulation simulation(scene, slipping_at(limit));
  push_move(simulation, 0.0, 2.0, Vector3d(0.0, 0.0, 0.7), Vector3d(0.0, 0.0, 0.7));
  simulation.push_button(0.0, true);
  simulation.advance_to(0.6);
  const bodies::BodyState a = simulation.objects()[0];
  EXPECT_NEAR(simulation.tool().tip_wrench_W.force.norm(), limit, 1e-6);
  simulation.advance_to(1.0);
  const bodies::BodyState b = simulation.objects()[0];
  const double acceleration = limit / 5.0 - g;
  EXPECT_NEAR(b.V_WO_W.linear.z() - a.V_WO_W.linear.z(), 0.4 * acceleration, 1e-3);
  EXPECT_NEAR(b.X_WO.translation().z() - a.X_WO.translation().z(),
              0.4 * a.V_WO_W.linear.z() + 0.5 * 0.16 * acceleration, 1e-3);
}

/// A limit of the moment: a box that is held far off its centre, level. While the tool slips the moment is at the
/// limit.
TEST(SlipInTheAir, TheMomentHasALimit) {
  SimulationSettings set = slipping_at(1e3);
  set.limit.moment = 0.3;
  scene::Scene scene = scene_of({box("box", {0.3, 0.06, 0.04}, 1.0, {0.1, 0.0, 0.5})}, scene::ContactMode::none);
  Simulation simulation(scene, set);
  push_move(simulation, 0.0, 2.0, Vector3d(0.0, 0.0, 0.7), Vector3d(0.0, 0.0, 0.7));
  simulation.push_button(0.0, true);
  int slipped = 0;
  double turned = 0.0;
  for (int i = 1; i <= 50; ++i) {
    simulation.advance_to(0.02 * i);
    const tools::ToolState f = simulation.tool();
    EXPECT_LT(f.tip_wrench_W.moment.norm(), 1.01 * 0.3);
    const double turn = math::turn_between(f.X_WH, f.X_WH_proxy).norm();
    const bool slips = turn > turned;  // it does not come back to the hand
    turned = turn;
    if (!slips) continue;
    ++slipped;
    EXPECT_NEAR(f.tip_wrench_W.moment.norm(), 0.3, 0.01 * 0.3) << i;
  }
  EXPECT_GT(slipped, 5);
  EXPECT_GT(gap(simulation), 1e-3);
}

/// Nothing jumps when the tool starts to slip and when it has returned to the hand, and a saved state continues
/// identically.
TEST(SlipInTheAir, WithoutALimitReachedItIsTheSame) {
  const auto run = [](const SimulationSettings& set) {
    Simulation simulation(one_box(1.0, scene::ContactMode::stop), set);
    push_move(simulation, 0.0, 2.0, above, above + Vector3d(0.1, 0.0, 0.2), 0.5);
    simulation.push_button(0.0, true);
    simulation.advance_to(2.0);
    return simulation.objects()[0].X_WO;
  };
  EXPECT_EQ(run(SimulationSettings()).matrix(), run(slipping_at(1e6)).matrix());
}

INSTANTIATE_TEST_SUITE_P(EveryMode, Slip, testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& tested) { return validation::name_of(tested.param); });

}  // namespace
}  // namespace spring_workbench::simulation::slip_test
