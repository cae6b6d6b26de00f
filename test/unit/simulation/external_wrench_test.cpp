// The wrench measured by a machine acts on the held object; the twist of the tip for a machine that follows it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/input_error.h"
#include "support/bench_scenes.h"
#include "support/named.h"

namespace spring_workbench::simulation::external_wrench_test {
namespace {

using motion::ExternalWrench;
using Axes = ExternalWrench::Axes;
const scene::ContactMode modes[] = {scene::ContactMode::none, scene::ContactMode::stop, scene::ContactMode::dynamic};
constexpr double g = 9.81, stretch = 2000.0, bend = 500.0, torsion = 5.0, size_z = 0.04;
const Vector3d above(0.0, 0.0, 0.7);  // the tip of a 0.2 m fork is at the box' centre

scene::Scene one_box(scene::ContactMode mode, double gravity = g, double z = 0.5) {
  scene::Scene scene = scene_of({box("box", {0.1, 0.06, size_z}, 1.0, {0.0, 0.0, z})}, mode);
  scene.gravity = gravity;
  return scene;
}

/// It holds the box at `handle`, at rest, from time 0 on.
Simulation holding(const scene::Scene& scene, SimulationSettings set = {}, const Vector3d& handle = above,
                   double turned = 0.0, double until = 30.0) {
  Simulation simulation(scene, set);
  for (double t = 0.0; t < until; t += 0.02) simulation.push_stylus({t, pointing_down(handle, turned)});
  simulation.push_button(0.0, true);
  return simulation;
}

/// The same wrench from `from` to `to` [s].
void measure(Simulation& simulation, double from, double to, const Wrench& wrench, Axes axes = Axes::world) {
  for (double t = from; t < to; t += 0.05) simulation.push_external_wrench({t, wrench, axes});
}

/// The law of each DOF's stiffness, whatever the mode of contact.
TEST(ExternalWrench, DeflectsTheForkByItselfOverTheStiffness) {
  for (const scene::ContactMode mode : modes) {
    for (const rod::ShapeKind shape : {rod::ShapeKind::bushing, rod::ShapeKind::linear}) {
      SimulationSettings set;
      set.fork.shape = shape;
      Simulation simulation = holding(one_box(mode, 0.0), set);
      measure(simulation, 1.0, 9.0, {{0.5, -0.25, -3.0}, {0.0, 0.0, 0.01}});
      simulation.advance_to(9.0);
      ASSERT_TRUE(simulation.objects()[0].held);
      const tools::ToolState fork = simulation.tool();
      const std::string what = validation::name_of(mode) + ", " + validation::name_of(shape);
      EXPECT_NEAR(fork.stretch, 3.0 / stretch, 2e-3 * 3.0 / stretch) << what;
      // The force stretches the bent fork as well: the deflection is that of the stiffness to first order.
      const Vector3d from_start = simulation.objects()[0].X_WO.translation() - Vector3d(0.0, 0.0, 0.5);
      EXPECT_NEAR(from_start.x(), 0.5 / bend, 0.1 * 0.5 / bend) << what;
      EXPECT_NEAR(from_start.y(), -0.25 / bend, 0.1 * 0.5 / bend) << what;
      EXPECT_NEAR(std::abs(fork.torsion), 0.01 / torsion, 1e-4) << what;
      // The tool exerts the remaining wrench: nothing moves.
      EXPECT_LT((fork.tip_wrench_W.force - Vector3d(-0.5, 0.25, 3.0)).norm(), 1e-4) << what;
    }
  }
}

TEST(ExternalWrench, OfTheWeightUpwardsBringsTheForkToItsRestLength) {
  for (const scene::ContactMode mode : modes) {
    for (const double scale : {1.0, 4.0}) {
      SimulationSettings set;
      set.force_scale = scale;
      Simulation simulation = holding(one_box(mode), set);
      simulation.advance_to(5.0);
      EXPECT_NEAR(simulation.tool().stretch, g / stretch, 1e-6);
      EXPECT_NEAR(simulation.tool().weight, scale == 1.0 ? 1.0 : simulation.tool().weight, 1e-4);
      measure(simulation, 5.0, 12.0, {{0.0, 0.0, g / scale}, Vector3d::Zero()});  // in real units
      simulation.advance_to(12.0);
      EXPECT_NEAR(simulation.tool().stretch, 0.0, 1e-7) << validation::name_of(mode);
      EXPECT_LT(simulation.tool().tip_wrench_W.force.norm(), 1e-3) << validation::name_of(mode);
    }
  }
}

/// On the bench, the bench carries the force of the machine, in addition to the contact force.
TEST(ExternalWrench, AddsToContact) {
  for (const scene::ContactMode mode : {scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    Simulation simulation = holding(one_box(mode, g, 0.5 * size_z), {}, {0.0, 0.0, 0.5 * size_z + 0.2});
    const auto carried = [&] {
      double force = 0.0;
      for (const contact::ContactState& c : simulation.contacts()) force += c.force * c.n_W.z();
      return force;
    };
    measure(simulation, 2.0, 4.0, {{0.0, 0.0, -20.0}, Vector3d::Zero()});
    simulation.advance_to(3.99);
    EXPECT_NEAR(carried() + simulation.tool().tip_wrench_W.force.z(), g + 20.0, 0.05) << validation::name_of(mode);
    EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), 0.5 * size_z, 1e-4);
    simulation.advance_to(6.0);  // the watchdog has ended it
    EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), 0.5 * size_z, 1e-4);
    // Pulled up by more than its weight, it rises.
    measure(simulation, 6.0, 8.0, {{0.0, 0.0, 30.0}, Vector3d::Zero()});
    simulation.advance_to(8.0);
    EXPECT_GT(simulation.objects()[0].X_WO.translation().z(), 0.5 * size_z + 5e-3) << validation::name_of(mode);
  }
}

TEST(ExternalWrench, InTipAxesItTurnsWithTheTip) {
  SimulationSettings set;
  set.fork.shape = rod::ShapeKind::bushing;
  Simulation simulation = holding(one_box(scene::ContactMode::none, 0.0), set, above, 0.5 * M_PI);
  measure(simulation, 1.0, 9.0, {{0.5, 0.0, 0.0}, Vector3d::Zero()}, Axes::tip);
  simulation.advance_to(9.0);
  const Vector3d gone = simulation.objects()[0].X_WO.translation() - Vector3d(0.0, 0.0, 0.5);
  const Vector3d x_E = simulation.tool().X_WE.linear().col(0);
  EXPECT_NEAR(std::abs(x_E.y()), 1.0, 1e-3);  // the fork points down and is turned
  EXPECT_NEAR(gone.y(), x_E.y() * 0.5 / bend, 1e-5);
  EXPECT_NEAR(gone.x(), 0.0, 1e-6);
}

/// About the tip, not about the object's centre.
TEST(ExternalWrench, ActsAtTheTip) {
  const double off = 0.03;
  SimulationSettings set;
  set.fork.dofs = {true, false, true};
  Simulation simulation = holding(one_box(scene::ContactMode::none, 0.0), set, above + Vector3d(off, 0.0, 0.0));
  measure(simulation, 1.0, 9.0, {{0.0, 1.0, 0.0}, {0.0, 0.0, 0.02}});
  simulation.advance_to(9.0);
  EXPECT_NEAR(std::abs(simulation.tool().torsion), 0.02 / torsion, 1e-6);  // the force has no lever
  EXPECT_NEAR(simulation.tool().tip_wrench_W.moment.z(), -0.02, 1e-5);
}

TEST(ExternalWrench, TheWatchdogEndsItAsAZeroDoes) {
  for (const scene::ContactMode mode : modes) {
    SimulationSettings set;
    set.external_wrench_timeout = 0.25;
    Simulation ended = holding(one_box(mode), set), zero = holding(one_box(mode), set);
    const Wrench pull{{3.0, 0.0, 5.0}, {0.0, 0.0, 0.1}};
    for (Simulation* simulation : {&ended, &zero}) simulation->push_external_wrench({1.0, pull, Axes::world});
    zero.push_external_wrench({1.25, Wrench(), Axes::world});
    AdvanceReport report;
    for (int i = 1; i <= 114; ++i) {  // until the zero has timed out, too
      report.add(ended.advance_to(0.013 * i));
      zero.advance_to(0.013 * i);
      ASSERT_EQ(ended.objects()[0].X_WO.matrix(), zero.objects()[0].X_WO.matrix()) << i;
      ASSERT_EQ(report.wrench_timeouts, 0.013 * i < 1.25 ? 0 : 1) << i;
    }
    ended.advance_to(8.0);
    EXPECT_NEAR(ended.tool().stretch, g / stretch, 1e-3 * g / stretch);
  }
}

/// It acts from its time on, in whatever calls time passes, and a late one at once.
TEST(ExternalWrench, ActsFromItsTimeOn) {
  const Wrench pull{{3.0, 0.0, 5.0}, Vector3d::Zero()};
  Simulation with = holding(one_box(scene::ContactMode::stop)), without = holding(one_box(scene::ContactMode::stop)),
             late = holding(one_box(scene::ContactMode::stop));
  with.push_external_wrench({1.005, pull, Axes::world});
  EXPECT_EQ(with.next_event_time(), 0.0);  // the first sample
  for (Simulation* simulation : {&with, &without, &late}) simulation->advance_to(1.0);
  EXPECT_EQ(with.next_event_time(), 1.005);
  for (Simulation* simulation : {&with, &without, &late}) simulation->advance_to(1.005);
  EXPECT_EQ(with.objects()[0].X_WO.matrix(), without.objects()[0].X_WO.matrix());
  late.push_external_wrench({1.0, pull, Axes::world});
  for (Simulation* simulation : {&with, &without, &late}) simulation->advance_to(1.02);
  EXPECT_NE(with.objects()[0].X_WO.matrix(), without.objects()[0].X_WO.matrix());
  EXPECT_EQ(with.objects()[0].X_WO.matrix(), late.objects()[0].X_WO.matrix());
}

TEST(ExternalWrench, WakesWhatRestsOnTheFork) {
  for (const tools::Tool tool : {tools::Tool::spring_fork, tools::Tool::spring}) {
    SimulationSettings set;
    set.tool = tool;
    Simulation simulation = holding(one_box(scene::ContactMode::stop), set);
    simulation.advance_to(20.0);
    if (tool == tools::Tool::spring_fork) {
      ASSERT_TRUE(simulation.objects()[0].asleep);
    }
    const double before = simulation.objects()[0].X_WO.translation().z();
    measure(simulation, 20.0, 24.0, {{0.0, 0.0, g}, Vector3d::Zero()});
    simulation.advance_to(24.0);
    EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z() - before, g / stretch, 1e-5);
    simulation.advance_to(29.0);
    EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), before, 1e-5);
  }
}

/// A rigid tool does not yield, and its wrench on the hand includes the machine's; a massless object is not affected.
TEST(ExternalWrench, OnARigidToolTheHandFeelsIt) {
  SimulationSettings set;
  set.tool = tools::Tool::direct;
  Simulation simulation = holding(one_box(scene::ContactMode::stop), set, {0.0, 0.0, 0.5});
  measure(simulation, 1.0, 3.0, {{2.0, 0.0, g}, Vector3d::Zero()});
  simulation.advance_to(3.0);
  EXPECT_LT((simulation.objects()[0].X_WO.translation() - Vector3d(0.0, 0.0, 0.5)).norm(), 1e-9);
  EXPECT_LT((simulation.tool().tip_wrench_W.force - Vector3d(-2.0, 0.0, 0.0)).norm(), 1e-9);
  set = SimulationSettings();
  set.massless = true;
  Simulation massless = holding(one_box(scene::ContactMode::stop), set);
  measure(massless, 1.0, 3.0, {{2.0, 0.0, 5.0}, Vector3d::Zero()});
  massless.advance_to(3.0);
  EXPECT_LT((massless.objects()[0].X_WO.translation() - Vector3d(0.0, 0.0, 0.5)).norm(), 1e-9);
}

/// Two hands on one object: what both machines measure adds.
TEST(ExternalWrench, ThoseOfTwoHandsAdd) {
  Simulation simulation = holding(one_box(scene::ContactMode::none));
  for (double t = 0.0; t < 20.0; t += 0.02) simulation.push_stylus({t, pointing_down(above)}, 1);
  simulation.push_button(0.1, true, 1);
  for (double t = 1.0; t < 15.0; t += 0.05) {
    simulation.push_external_wrench({t, {{0.0, 0.0, 0.75 * g}, Vector3d::Zero()}, Axes::world}, 0);
    simulation.push_external_wrench({t, {{0.0, 0.0, 0.25 * g}, Vector3d::Zero()}, Axes::world}, 1);
  }
  simulation.advance_to(15.0);
  ASSERT_EQ(simulation.tool(1).held_object, "box");
  EXPECT_NEAR(simulation.tool(0).tip_wrench_W.force.z() + simulation.tool(1).tip_wrench_W.force.z(), 0.0, 1e-3);
}

/// Beyond its limit the tool slips, and the machine's wrench continues to act.
TEST(ExternalWrench, ActsWhileTheToolSlips) {
  SimulationSettings set;
  set.limit.force = 12.0;
  set.limit.action = tools::LimitAction::slip;
  Simulation simulation = holding(one_box(scene::ContactMode::none), set);
  measure(simulation, 1.0, 3.0, {{0.0, 0.0, -5.0}, Vector3d::Zero()});
  simulation.advance_to(1.0);
  const double z = simulation.objects()[0].X_WO.translation().z();
  simulation.advance_to(3.0);  // 2.81 N more than the tool can do, on 1 kg
  const double fallen = z - simulation.objects()[0].X_WO.translation().z();
  EXPECT_NEAR(fallen, 0.5 * 2.81 * 2.0 * 2.0, 0.1);
}

TEST(ExternalWrench, RefusedItChangesNothing) {
  Simulation simulation = holding(one_box(scene::ContactMode::stop));
  measure(simulation, 1.0, 2.0, {{1.0, 0.0, 0.0}, Vector3d::Zero()});
  simulation.advance_to(1.5);
  const std::uint64_t before = simulation.state_hash();
  ExternalWrench bad{1.6, {{std::nan(""), 0.0, 0.0}, Vector3d::Zero()}, Axes::world};
  EXPECT_THROW(simulation.push_external_wrench(bad), validation::InputError);
  bad.wrench.force.x() = 2e5;
  EXPECT_THROW(simulation.push_external_wrench(bad), validation::InputError);
  EXPECT_THROW(simulation.push_external_wrench({1.6, Wrench(), Axes::world}, 2), validation::InputError);
  EXPECT_EQ(simulation.state_hash(), before);
}

/// The largest that is allowed: all stays finite. In contact the box then spins so fast that a hundredth of a second
/// may take ten seconds, so what comes after is judged without.
TEST(ExternalWrench, TheLargestLeavesEverythingFinite) {
  for (const scene::ContactMode mode : modes) {
    Simulation simulation = holding(one_box(mode));
    for (double t = 1.0; t < 1.15; t += 0.03) {
      const double sign = std::sin(60.0 * t) > 0.0 ? 1.0 : -1.0;
      simulation.push_external_wrench({t, {sign * Vector3d(1e5, -1e5, 1e5), 1e5 * Vector3d::Ones()}, Axes::tip});
    }
    const int end = mode == scene::ContactMode::none ? 130 : 110;
    for (int i = 1; i < end; ++i) {
      simulation.advance_to(0.01 * i);
      ASSERT_TRUE(simulation.objects()[0].X_WO.matrix().allFinite()) << validation::name_of(mode) << " " << i;
      ASSERT_TRUE(simulation.objects()[0].V_WO_W.linear.allFinite()) << validation::name_of(mode) << " " << i;
    }
  }
}

/// Stamps equal to those of the hand's samples up to rounding do not cause extra steps.
TEST(ExternalWrench, ARoundingErrorNextToASampleAddsNoStep) {
  for (const double off : {0.0, 1e-13, -1e-13}) {
    Simulation simulation = holding(one_box(scene::ContactMode::stop));
    AdvanceReport report = simulation.advance_to(0.99);
    for (int i = 51; i < 60; ++i) {
      simulation.push_external_wrench({0.02 * i + off, {{0.1 * i, 0.0, 0.0}, Vector3d::Zero()}, Axes::world});
    }
    report = simulation.advance_to(1.17);
    EXPECT_EQ(report.steps, 8) << off;  // from one sample to the next; before the first wrench it rests
  }
}

/// Saved at any time, with wrenches under way, and restored elsewhere: the same future.
TEST(ExternalWrench, IsPartOfTheState) {
  for (const scene::ContactMode mode : modes) {
    for (const double at : {0.9, 1.003, 1.5, 2.04, 8.0}) {
      Simulation first = holding(one_box(mode)), second(one_box(mode), SimulationSettings());
      measure(first, 1.0, 2.0, {{1.0, -2.0, 4.0}, {0.0, 0.01, 0.05}}, Axes::tip);
      first.advance_to(at);
      second.restore(first.save());
      EXPECT_EQ(second.state_hash(), first.state_hash());
      for (double t = at; t < at + 1.5; t += 0.017) {
        first.advance_to(t);
        second.advance_to(t);
        ASSERT_EQ(second.state_hash(), first.state_hash())
            << validation::name_of(mode) << " from " << at << " at " << t;
      }
    }
  }
}

/// The tip's twist is the derivative of its pose, whatever the tool, with an object and without.
TEST(TipTwist, IsTheDerivativeOfTheTipsPose) {
  for (const tools::Tool tool :
       {tools::Tool::spring_fork, tools::Tool::spring, tools::Tool::direct, tools::Tool::ray}) {
    for (const bool holds : {true, false}) {
      SimulationSettings set;
      set.tool = tool;
      Simulation simulation(one_box(scene::ContactMode::none), set);
      const double z = tool == tools::Tool::direct ? 0.51 : 0.71;
      for (double t = 0.0; t < 3.0; t += 0.02) {
        RigidTransform X = pointing_down({0.02 + 0.1 * std::sin(2.0 * t), 0.01 * std::cos(3.0 * t), z + 0.02 * t}, t);
        X.rotate(Eigen::AngleAxisd(0.3 * std::sin(4.0 * t), Vector3d::UnitY()));
        simulation.push_stylus({t, X});
      }
      if (holds) simulation.push_button(0.0, true);
      for (const double t : {0.613, 1.131, 2.007}) {
        constexpr double dt = 1e-5;
        simulation.advance_to(t - dt);
        const RigidTransform before = simulation.tool().X_WE;
        simulation.advance_to(t);
        const tools::ToolState now = simulation.tool();
        ASSERT_EQ(now.held_object, holds ? "box" : "");
        simulation.advance_to(t + dt);
        const RigidTransform after = simulation.tool().X_WE;
        const Vector3d v = (after.translation() - before.translation()) / (2.0 * dt);
        const Eigen::AngleAxisd turn(after.linear() * before.linear().transpose());
        const Vector3d w = turn.angle() / (2.0 * dt) * turn.axis();
        const std::string what = validation::name_of(tool) + (holds ? ", held" : "") + " at " + std::to_string(t);
        EXPECT_LT((now.V_WE_W.linear - v).norm(), 1e-4) << what;
        EXPECT_LT((now.V_WE_W.angular - w).norm(), 1e-3) << what;
        EXPECT_GT(now.V_WE_W.linear.norm(), 1e-3) << what;
      }
    }
  }
}

TEST(TipTwist, IsZeroWhileTheClutchIsOn) {
  Simulation simulation(one_box(scene::ContactMode::none), SimulationSettings());
  push_move(simulation, 0.0, 2.0, above + Vector3d(0.2, 0.0, 0.3), above + Vector3d(0.5, 0.0, 0.3));
  simulation.advance_to(0.5);
  EXPECT_GT(simulation.tool().V_WE_W.linear.norm(), 0.1);
  simulation.push_clutch(0.5, true);
  simulation.advance_to(0.6);
  EXPECT_EQ(simulation.tool().V_WE_W.linear.norm(), 0.0);
}

}  // namespace
}  // namespace spring_workbench::simulation::external_wrench_test
