// Any number of styluses: each has a tool of its own, and all tools on one object are in one equation of motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"
#include "support/named.h"

namespace spring_workbench::simulation::many_hands_test {
namespace {

constexpr double g = 9.81;
constexpr double mass = 3.0;
const Vector3d size(0.2, 0.2, 0.04);

SimulationSettings with(std::size_t styluses, const std::string& shape = "linear") {
  SimulationSettings set;
  set.styluses = static_cast<int>(styluses);
  set.fork.shape = test_support::shape_named(shape);
  set.fork.stiffness = {2000.0, 500.0, 5.0};
  return set;
}

/// A plate of 3 kg in the air.
scene::Scene plate() { return scene_of({box("plate", size, mass, Vector3d(0, 0, 0.5))}, scene::ContactMode::none); }

/// Where hand `k` of `n` is, around the plate's middle.
Vector3d place(std::size_t k, std::size_t n) {
  const double angle = 2.0 * M_PI * static_cast<double>(k) / static_cast<double>(n);
  return {0.07 * std::cos(angle), 0.07 * std::sin(angle), 0.7};
}

double distance(const bodies::BodyState& a, const bodies::BodyState& b) {
  return (a.X_WO.matrix() - b.X_WO.matrix()).norm();
}

TEST(ManyHands, AroundTheMiddleEachCarriesItsShare) {
  for (const std::string& shape : test_support::shape_names()) {
    for (const std::size_t n : {1u, 2u, 3u, 5u, 8u}) {
      Simulation simulation(plate(), with(n, shape));
      for (std::size_t hand = 0; hand < n; ++hand) {
        simulation.push_stylus({0.0, pointing_down(n == 1 ? Vector3d(0, 0, 0.7) : place(hand, n))}, hand);
        simulation.push_button(0.0, true, hand);
      }
      simulation.advance_to(8.0);
      const double share = mass / static_cast<double>(n);
      EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), 0.5 - share * g / 2000.0, 1e-6) << shape << n;
      for (std::size_t hand = 0; hand < n; ++hand) {
        EXPECT_NEAR(simulation.tool(hand).weight, share, 1e-5) << shape << n;
        EXPECT_LT(simulation.tool(hand).tip_wrench_W.force.head<2>().norm(), 1e-4) << shape << n;
      }
    }
  }
}

/// State of a plate held by three hands, each with its own motion, springs and time of grasp. `number[k]`: stylus of
/// hand k.
std::vector<bodies::BodyState> carried_by_three(const std::vector<std::size_t>& number, const std::string& shape) {
  Simulation simulation(plate(), with(3, shape));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d from = place(k, 3), to = from + Vector3d(0.1, 0.03 * static_cast<double>(k), 0.1);
    simulation.push_stylus({0.0, pointing_down(from)}, number[k]);
    push_move(simulation, 0.06, 1.0, from, to, 0.3, number[k]);
    simulation.push_button(0.02 * static_cast<double>(k), true, number[k]);
    ForkChange springs;
    springs.stiffness.stretch = 1000.0 * static_cast<double>(k + 1);
    simulation.change(springs, {}, number[k]);
  }
  std::vector<bodies::BodyState> path;
  for (double t = 0.1; t < 1.5; t += 0.05) {
    simulation.advance_to(t);
    path.push_back(simulation.objects()[0]);
  }
  for (std::size_t hand = 0; hand < 3; ++hand) EXPECT_EQ(simulation.tool(hand).held_object, "plate");
  return path;
}

TEST(ManyHands, TheirNumbersChangeNothing) {
  for (const std::string& shape : test_support::shape_names()) {
    std::vector<std::size_t> number{0, 1, 2};
    const std::vector<bodies::BodyState> expected = carried_by_three(number, shape);
    while (std::next_permutation(number.begin(), number.end())) {
      const std::vector<bodies::BodyState> path = carried_by_three(number, shape);
      for (std::size_t i = 0; i < path.size(); ++i) EXPECT_LT(distance(path[i], expected[i]), 1e-9) << shape;
    }
  }
}

/// Four hands, each with an object of its own.
struct Apart {
  explicit Apart(std::size_t styluses = 4, std::size_t used = 4)
      : simulation(scene_of({box("a", size, 1.0, at(0)), box("b", size, 2.0, at(1)), box("c", size, 0.5, at(2)),
                             box("d", size, 4.0, at(3))},
                            scene::ContactMode::stop),
                   with(styluses)) {
    for (std::size_t hand = 0; hand < used; ++hand) {
      const Vector3d p = at(hand) + Vector3d(0.02, 0.01, 0.2);
      push_move(simulation, 0.0, 1.0, p, p + Vector3d(0.05, 0.1, 0.1), 0.4, hand);
      simulation.push_button(0.0, true, hand);
    }
    simulation.advance_to(0.3);
  }
  static Vector3d at(std::size_t k) { return {0.5 * static_cast<double>(k), 0.0, 0.5}; }
  Simulation simulation;
};

TEST(ManyHands, WhatIsSetForOneNeverChangesTheOthers) {
  Apart undisturbed;
  undisturbed.simulation.advance_to(1.2);
  std::mt19937 random(7);
  for (int trial = 0; trial < 24; ++trial) {
    Apart apart;
    Simulation& s = apart.simulation;
    const std::size_t hand = random() % 4;
    ForkChange change;
    const auto number = [&] { return std::uniform_real_distribution<double>(0.1, 5.0)(random); };
    change.stiffness.stretch = 1e3 * number();
    change.damping_ratio = {number(), number(), number()};
    if (trial % 3 == 0) change.dofs = {trial % 2 == 0, true, false};
    s.change(change, {}, hand);
    if (trial % 4 == 1) s.select_tool(static_cast<tools::Tool>(random() % 5), hand);
    if (trial % 4 == 2) s.calibrate(hand);
    if (trial % 4 == 3) s.push_clutch(0.4, true, hand);
    if (trial % 5 == 4) s.release(hand);
    if (trial % 5 == 3) s.push_external_wrench({0.4, {{1.0, 2.0, 3.0}, Vector3d::Zero()}, {}}, hand);
    s.advance_to(1.2);
    for (std::size_t other = 0; other < 4; ++other) {
      if (other == hand) continue;
      EXPECT_EQ(distance(s.objects()[other], undisturbed.simulation.objects()[other]), 0.0) << trial;
      EXPECT_EQ(s.tool(other).stiffness.stretch, undisturbed.simulation.tool(other).stiffness.stretch);
      EXPECT_EQ(s.tool(other).strain, undisturbed.simulation.tool(other).strain);
    }
    EXPECT_NE(s.tool(hand).stiffness.stretch, undisturbed.simulation.tool(hand).stiffness.stretch);
  }
}

/// Of all together, and of one after the other, on one object and while it moves.
TEST(ManyHands, SettingThePresentValueMovesNothing) {
  for (const std::string& shape : test_support::shape_names()) {
    const auto run = [&](bool again) {
      Simulation s(plate(), with(3, shape));
      for (std::size_t hand = 0; hand < 3; ++hand) {
        push_move(s, 0.0, 1.0, place(hand, 3), place(hand, 3) + Vector3d(0.1, 0.0, 0.1), 0.3, hand);
        s.push_button(0.0, true, hand);
      }
      for (std::size_t k = 1; k < 12; ++k) {
        s.advance_to(0.1 * static_cast<double>(k));
        if (!again) continue;
        const rod::ForkSettings& fork = s.fork_settings(k % 3);
        ForkChange same = k % 2 == 0 ? change_to(fork) : ForkChange();
        same.damping_ratio = change_to(fork).damping_ratio;
        s.change(same, {}, k % 4 == 3 ? std::nullopt : std::optional<std::size_t>(k % 4));
      }
      return s.objects()[0];
    };
    EXPECT_EQ(distance(run(true), run(false)), 0.0) << shape;
  }
}

TEST(ManyHands, AReleasingHandLeavesTheWeightToTheOthers) {
  for (const std::string& shape : test_support::shape_names()) {
    Simulation s(plate(), with(4, shape));
    for (std::size_t hand = 0; hand < 4; ++hand) {
      s.push_stylus({0.0, pointing_down(place(hand, 4))}, hand);
      s.push_button(0.02 * static_cast<double>(hand), true, hand);
    }
    s.advance_to(6.0);
    const bodies::BodyState before = s.objects()[0];
    for (const std::size_t leaves : {2u, 0u, 3u}) {
      s.push_button(s.time(), false, leaves);
      double farthest = 0.0, carried = 0.0;
      const double begin = s.time();
      for (double t = 0.02; t < 2.0; t += 0.02) {
        s.advance_to(begin + t);
        farthest = std::max(farthest, (s.objects()[0].X_WO.translation() - before.X_WO.translation()).norm());
      }
      EXPECT_EQ(s.tool(leaves).held_object, "");
      EXPECT_LT(farthest, 1e-4) << shape << leaves;
      for (std::size_t hand = 0; hand < 4; ++hand) carried += s.tool(hand).tip_wrench_W.force.z();
      EXPECT_NEAR(carried, mass * g, 1e-3) << shape << leaves;
    }
    EXPECT_EQ(s.tool(1).held_object, "plate");
  }
}

/// Of two styluses of one tracker, whose stamps are equal but for rounding, the second one begins in the middle: it
/// grasps, or touches with its probe, at its first sample.
TEST(ManyHands, AFirstSampleThatIsARoundingErrorLaterIsOfTheSameTime) {
  for (const tools::Tool tool : {tools::Tool::spring_fork, tools::Tool::spring, tools::Tool::spring_probe}) {
    for (const double later : {-4e-10, -1e-15, 0.0, 1e-15, 4e-10}) {
      Simulation s(plate(), with(2));
      s.select_tool(tool, 1);
      const Vector3d above(0.05, 0.0, tool == tools::Tool::spring_probe ? 0.71 : 0.7);
      for (int k = 0; k <= 20; ++k) s.push_stylus({0.02 * k, pointing_down(Vector3d(0.3, 0.0, 0.7))});
      for (int k = 5; k <= 20; ++k) s.push_stylus({0.02 * k + later, pointing_down(above)}, 1);
      s.push_button(0.1 + later, true, 1);
      std::int64_t acts = 0, steps = 0;
      for (int k = 1; k <= 20; ++k) {
        ASSERT_NO_THROW(steps += s.advance_to(0.02 * k).steps) << later;
        const tools::ToolState f = s.tool(1);
        acts += f.touched == "plate" || f.held_object == "plate" ? 1 : 0;
      }
      EXPECT_GT(acts, 0) << validation::name_of(tool) << later;
      EXPECT_LE(steps, 16) << later;  // none of the length of a rounding error
    }
  }
}

TEST(ManyHands, ThatAreNotUsedChangeNothing) {
  Apart one(1, 1), many(255, 1);
  const AdvanceReport of_one = one.simulation.advance_to(1.2), of_many = many.simulation.advance_to(1.2);
  EXPECT_EQ(distance(one.simulation.objects()[0], many.simulation.objects()[0]), 0.0);
  EXPECT_EQ(of_one.steps, of_many.steps);
  EXPECT_EQ(of_one.collision_queries, of_many.collision_queries);
  EXPECT_EQ(of_one.ran, of_many.ran);
  EXPECT_FALSE(many.simulation.tool(254).present);
}

TEST(ManyHands, AnyNumberFromOneTo255) {
  for (const int styluses : {-1, 0, 256}) {
    SimulationSettings set;
    set.styluses = styluses;
    EXPECT_THROW(Simulation(plate(), set), validation::InputError) << styluses;
  }
  for (const std::size_t styluses : {1u, 3u, 255u}) {
    Simulation s(plate(), with(styluses));
    EXPECT_EQ(s.hands(), styluses);
    EXPECT_THROW(s.push_stylus({0.0, pointing_down(place(0, 1))}, styluses), validation::InputError);
    EXPECT_THROW(s.tool(styluses), validation::InputError);
    s.push_stylus({0.0, pointing_down(Vector3d(0, 0, 0.7))}, styluses - 1);
    s.push_button(0.0, true, styluses - 1);
    s.advance_to(0.1);
    EXPECT_EQ(s.tool(styluses - 1).held_object, "plate");
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::many_hands_test
