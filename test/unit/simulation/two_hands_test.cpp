// Two styluses: two tools on one object and on two.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"
#include "support/named.h"

namespace spring_workbench::simulation::two_hands_test {
namespace {

constexpr double g = 9.81;
const Vector3d size(0.2, 0.06, 0.04);
const Vector3d left(-0.05, 0.0, 0.7), right(0.05, 0.0, 0.7);  // handles: the tips are in the box at 0.5 m

SimulationSettings with_stiffness(double stretch, double bend, double torsion, const std::string& shape = "linear") {
  SimulationSettings set;
  set.fork.shape = test_support::shape_named(shape);
  set.fork.stiffness = {stretch, bend, torsion};
  return set;
}

/// A box that both hands grasp, one after the other, the hands at rest.
struct BothHold {
  explicit BothHold(const SimulationSettings& set, double mass = 2.0,
                    scene::ContactMode contact = scene::ContactMode::none)
      : simulation(scene_of({box("box", size, mass, Vector3d(0, 0, 0.5))}, contact), set) {
    rest(0, left);
    rest(1, right);
    simulation.push_button(0.0, true, 0);
    simulation.push_button(0.02, true, 1);
    simulation.advance_to(0.2);
  }
  void rest(std::size_t hand, const Vector3d& p) {
    simulation.push_stylus({0.0, pointing_down(p)}, hand);
    simulation.push_stylus({0.02, pointing_down(p)}, hand);
  }
  Vector3d p() const { return simulation.objects()[0].X_WO.translation(); }
  Simulation simulation;
};

TEST(TwoHands, ObjectOfTwoKilogramsOnTwoForksSagsHalf) {
  for (const std::string& shape : test_support::shape_names()) {
    for (const double k : {2e2, 2e3, 2e5, 2e9}) {
      const SimulationSettings set = with_stiffness(k, 500.0, 5.0, shape);
      BothHold two(set);
      ASSERT_EQ(two.simulation.tool(0).held_object, "box");
      ASSERT_EQ(two.simulation.tool(1).held_object, "box");
      two.simulation.advance_to(6.0);
      // Each started without strain, and the first one sagged before the second grasped, so the shares differ.
      const tools::ToolState a = two.simulation.tool(0), b = two.simulation.tool(1);
      EXPECT_NEAR(a.tip_wrench_W.force.z() + b.tip_wrench_W.force.z(), 2.0 * g, 1e-5 * 2.0 * g) << shape << k;
      EXPECT_LT(two.simulation.objects()[0].V_WO_W.linear.norm(), 1e-6) << shape << k;
    }
  }
  // Both at once: half the weight, and half the sag of one fork, on each.
  const double k = 2000.0;
  Simulation simulation(scene_of({box("box", size, 2.0, Vector3d(0, 0, 0.5))}, scene::ContactMode::none),
                        with_stiffness(k, 500.0, 5.0));
  for (std::size_t hand = 0; hand < 2; ++hand) {
    simulation.push_stylus({0.0, pointing_down(hand == 0 ? left : right)}, hand);
    simulation.push_button(0.0, true, hand);
  }
  simulation.advance_to(6.0);
  EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), 0.5 - 0.5 * 2.0 * g / k, 1e-6);
  for (std::size_t hand = 0; hand < 2; ++hand) {
    EXPECT_NEAR(simulation.tool(hand).stretch, 0.5 * 2.0 * g / k, 1e-6);
    EXPECT_NEAR(simulation.tool(hand).tip_wrench_W.force.z(), g, 1e-5);
    EXPECT_NEAR(simulation.tool(hand).weight, 1.0, 1e-6);
  }
}

TEST(TwoHands, OneSpringAndOneForkShareTheWeight) {
  BothHold two(with_stiffness(2000.0, 500.0, 5.0));
  two.simulation.select_tool(tools::Tool::spring, 1);
  two.simulation.advance_to(20.0);
  const double sum = two.simulation.tool(0).tip_wrench_W.force.z() + two.simulation.tool(1).tip_wrench_W.force.z();
  EXPECT_NEAR(sum, 2.0 * g, 1e-4);
  EXPECT_GT(two.simulation.tool(1).tip_wrench_W.force.norm(), 0.1);
}

TEST(TwoHands, MessagesNameWhatEachHandGot) {
  BothHold two(with_stiffness(2000.0, 500.0, 5.0));
  const auto set_stretch = [&](double k, std::optional<std::size_t> hand) {
    rod::ForkChange change;
    change.stiffness.stretch = k;
    return two.simulation.change(change, {}, hand).message;
  };
  const auto forks_named = [](const std::string& message) {
    int forks = 0;
    for (std::size_t at = message.find("stiffness "); at != message.npos; at = message.find("stiffness ", at + 1)) {
      ++forks;
    }
    return forks;
  };
  set_stretch(1000.0, 0);
  const std::string alike = set_stretch(3000.0, std::nullopt);
  EXPECT_EQ(forks_named(alike), 1) << alike;
  rod::ForkChange bend_of_one;
  bend_of_one.stiffness.bend = 700.0;
  two.simulation.change(bend_of_one, {}, 1);
  const std::string unlike = set_stretch(4000.0, std::nullopt);
  EXPECT_EQ(forks_named(unlike), 2) << unlike;
  EXPECT_NE(unlike.find("700"), std::string::npos) << unlike;
  EXPECT_EQ(two.simulation.calibrate().message, "calibrated for box");
}

/// Largest speed of a box that two hands carry, each turning about its own fork [m/s].
double fastest(const SimulationSettings& set) {
  BothHold two(set, 0.5, scene::ContactMode::stop);
  push_move(two.simulation, 0.22, 1.0, left, left + Vector3d(0.1, 0.05, 0.1), 0.4, 0);
  push_move(two.simulation, 0.22, 1.0, right, right + Vector3d(0.1, 0.05, 0.1), 0.4, 1);
  double speed = 0.0;
  for (double t = 0.3; t < 2.0; t += 0.05) {
    two.simulation.advance_to(t);
    const bodies::BodyState& o = two.simulation.objects()[0];
    EXPECT_TRUE(o.X_WO.matrix().allFinite());
    EXPECT_LT(o.X_WO.translation().norm(), 1.0);
    speed = std::max(speed, o.V_WO_W.linear.norm());
  }
  return speed;
}

TEST(TwoHands, NoStiffnessMakesItBlowUp) {
  for (const double k : {0.0, 1.0, 1e6, 1e12}) {
    for (const std::string& shape : test_support::shape_names()) {
      for (const rod::ForkDofs& dofs :
           {rod::ForkDofs{true, true, true}, rod::ForkDofs{false, true, false}, rod::ForkDofs{false, false, false}}) {
        SCOPED_TRACE(std::to_string(k) + shape);
        SimulationSettings set = with_stiffness(k, k, 1e-2 * k, shape);
        set.fork.dofs = dofs;
        // A limp arc of fixed length: what is rigid in both forks leaves the box hardly a way, along which the hands
        // force it. It goes so fast by its equation of motion, at any step.
        const bool limp = shape == "constant" && k <= 1.0 && dofs.bend && !dofs.stretch;
        const double speed = fastest(set);
        ASSERT_LT(speed, limp ? 10.0 : 5.0);
        set.dynamics.step = 2e-3;
        if (limp) {
          ASSERT_NEAR(speed, fastest(set), 0.01 * speed);
        }
      }
    }
  }
}

/// Hands that pass through each other and wind up the forks beyond their range, and come to rest again.
TEST(TwoHands, HandsThatPassThroughEachOtherLeaveAllFiniteAndThenCarryTheWeight) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 6; ++trial) {
    const std::string shape = test_support::shape_names()[static_cast<std::size_t>(trial) % 3];
    SimulationSettings set = with_stiffness(2000.0, 500.0, 5.0, shape);
    if (trial % 2 == 1) set.fork.dofs.stretch = false;
    BothHold two(set);
    for (std::size_t hand = 0; hand < 2; ++hand) {
      const Vector3d a(uniform(random), uniform(random), uniform(random)), turned(uniform(random), 0, uniform(random));
      for (double t = 0.22; t < 2.5; t += 0.02) {
        const double u = std::min(1.0, (t - 0.22) / 2.0), away = std::sin(M_PI * u),
                     there = 0.5 * (1 - std::cos(6 * M_PI * u));
        RigidTransform X = pointing_down((hand == 0 ? left : right) + 0.3 * there * a);
        X.linear() = math::exp_so3(3.0 * away * turned) * X.linear();
        two.simulation.push_stylus({t, X}, hand);
      }
    }
    for (double t = 0.3; t < 2.5; t += 0.01) {
      two.simulation.advance_to(t);
      for (std::size_t hand = 0; hand < 2; ++hand) {
        const tools::ToolState f = two.simulation.tool(hand);
        ASSERT_TRUE(f.strain.allFinite() && f.X_WE.matrix().allFinite() && f.tip_wrench_W.force.allFinite() &&
                    f.tip_wrench_W.moment.allFinite())
            << shape << trial << " at " << t;
      }
      ASSERT_TRUE(two.simulation.objects()[0].X_WO.matrix().allFinite());
    }
    two.simulation.advance_to(12.0);
    const double carried =
        two.simulation.tool(0).tip_wrench_W.force.z() + two.simulation.tool(1).tip_wrench_W.force.z();
    EXPECT_NEAR(carried, 2.0 * g, 1e-3 * 2.0 * g) << shape << trial;
  }
}

TEST(TwoHands, AForkPushedPastItsEndLeavesItsHandleBehindUntilItComesBack) {
  BothHold two(with_stiffness(2000.0, 500.0, 5.0));
  ForkChange stiff;
  stiff.stiffness.stretch = stiff.stiffness.bend = stiff.stiffness.torsion = 1e9;
  two.simulation.change(stiff, {}, 0);
  const double L = two.simulation.tool(1).length;
  push_move(two.simulation, 0.22, 1.0, right, right - Vector3d(0.0, 0.0, 1.5 * L), 0.0, 1);
  push_move(two.simulation, 1.22, 2.0, right - Vector3d(0.0, 0.0, 1.5 * L), right, 0.0, 1);
  const Vector3d p_OE = two.simulation.objects()[0].X_WO.inverse() * two.simulation.tool(1).X_WE.translation();
  double widest = 0.0;
  for (double t = 0.3; t < 2.2; t += 0.01) {
    two.simulation.advance_to(t);
    const tools::ToolState f = two.simulation.tool(1);
    ASSERT_TRUE(f.strain.allFinite() && f.tip_wrench_W.force.allFinite());
    const RigidTransform& X_WO = two.simulation.objects()[0].X_WO;
    // The tip is where it took hold of the object, also where the handle is not.
    EXPECT_LT((X_WO.inverse() * f.X_WE.translation() - p_OE).norm(), 1e-9) << t;
    widest = std::max(widest, (f.X_WH_proxy.translation() - f.X_WH.translation()).norm());
  }
  EXPECT_GT(widest, 1e-4);
  EXPECT_LT(widest, 0.1 * L);
  two.simulation.advance_to(6.0);
  const tools::ToolState f = two.simulation.tool(1);
  EXPECT_EQ(f.X_WH_proxy.matrix(), f.X_WH.matrix());
  EXPECT_NEAR(f.tip_wrench_W.force.z() + two.simulation.tool(0).tip_wrench_W.force.z(), 2.0 * g, 1e-4);
}

/// For any stiffness, the second fork takes over the force of both.
TEST(TwoHands, HandoverMovesTheObjectLessThanAMillimetre) {
  for (const std::string& shape : test_support::shape_names()) {
    for (const double soft : {0.5, 1.0, 10.0, 100.0}) {  // 1: what calibration gives 2 kg on a fork of 0.2 m
      const double k = soft * 2.0 * g / 0.02;
      BothHold two(with_stiffness(k, k, 5.0 * soft, shape));
      two.simulation.advance_to(6.0);
      const bodies::BodyState before = two.simulation.objects()[0];
      const double height = before.X_WO.translation().z();
      two.simulation.push_button(6.0, false, 0);
      two.simulation.advance_to(6.0 + 1e-6);
      EXPECT_EQ(two.simulation.tool(0).held_object, "");
      EXPECT_EQ(two.simulation.tool(1).held_object, "box");
      EXPECT_TRUE(two.simulation.objects()[0].held);
      EXPECT_LT((two.simulation.objects()[0].X_WO.matrix() - before.X_WO.matrix()).norm(), 1e-9);
      double farthest = 0.0, max_turned = 0.0, fastest = 0.0;
      for (double t = 6.01; t < 8.0; t += 0.01) {
        two.simulation.advance_to(t);
        const bodies::BodyState& o = two.simulation.objects()[0];
        farthest = std::max(farthest, (o.X_WO.translation() - before.X_WO.translation()).norm());
        max_turned = std::max(max_turned, (o.X_WO.linear() - before.X_WO.linear()).norm());
        fastest = std::max(fastest, o.V_WO_W.linear.norm());
      }
      EXPECT_LT(farthest, 1e-4) << shape << ": " << k;
      EXPECT_LT(max_turned, 1e-3) << shape << ": " << k;
      EXPECT_LT(fastest, 1e-3) << shape << ": " << k;  // no energy comes from it
      EXPECT_NEAR(two.simulation.tool(1).tip_wrench_W.force.z(), 2.0 * g, 1e-4) << shape << ": " << k;
      EXPECT_NEAR(two.p().z(), height, 1e-4);
    }
  }
}

/// The hands keep moving together while one releases and grasps again: the object continues with them.
TEST(TwoHands, AHandoverInMotionDoesNotDisturbTheObject) {
  const auto run = [](bool hand_over) {
    BothHold two(with_stiffness(981.0, 981.0, 5.0));
    const Vector3d path(0.2, 0.1, 0.1);
    for (std::size_t hand = 0; hand < 2; ++hand) {
      const Vector3d from = hand == 0 ? left : right;
      for (double t = 0.22; t < 3.0; t += 0.02) {
        const double u = std::clamp(t - 1.0, 0.0, 1.0), s = u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
        two.simulation.push_stylus({t, pointing_down(from + s * path)}, hand);
      }
    }
    if (hand_over) two.simulation.push_button(1.5, false, 0);
    std::vector<Vector3d> places;
    for (double t = 0.3; t < 2.99; t += 0.01) {
      two.simulation.advance_to(t);
      places.push_back(two.p());
    }
    return places;
  };
  const std::vector<Vector3d> both = run(false), one = run(true);
  double farthest = 0.0;
  for (std::size_t i = 0; i < both.size(); ++i) farthest = std::max(farthest, (both[i] - one[i]).norm());
  EXPECT_LT(farthest, 5e-3);  // one fork lags more than two
  EXPECT_LT((both.back() - one.back()).norm(), 1e-3);
}

TEST(TwoHands, HandoverFromAForkToASpringKeepsTheHeight) {
  BothHold two(with_stiffness(981.0, 981.0, 5.0));
  two.simulation.push_stylus({0.5, pointing_down({0.0, 0.0, 0.7})}, 1);  // above the centre
  two.simulation.advance_to(0.6);
  two.simulation.select_tool(tools::Tool::spring, 1);
  two.simulation.advance_to(6.0);
  const Vector3d before = two.p();
  two.simulation.push_button(6.0, false, 0);
  for (double t = 6.0; t < 8.0; t += 0.02) {
    two.simulation.advance_to(t);
    EXPECT_NEAR(two.p().z(), before.z(), 1e-3);
  }
  EXPECT_NEAR(two.simulation.tool(1).tip_wrench_W.force.norm(), 2.0 * g, 0.1);
}

TEST(TwoHands, HandoverBetweenRigidToolsMovesNothing) {
  SimulationSettings set;
  set.tool = tools::Tool::direct;
  Simulation simulation(scene_of({box("box", size, 2.0, Vector3d(0, 0, 0.5))}, scene::ContactMode::none), set);
  for (std::size_t hand = 0; hand < 2; ++hand) {
    simulation.push_stylus({0.0, pointing_down({hand == 0 ? -0.05 : 0.05, 0.0, 0.5})}, hand);
  }
  simulation.push_button(0.0, true, 0);
  simulation.push_button(0.5, true, 1);
  simulation.push_button(1.0, false, 0);
  for (double t = 0.1; t < 2.0; t += 0.1) {
    simulation.advance_to(t);
    EXPECT_LT((simulation.objects()[0].X_WO.translation() - Vector3d(0, 0, 0.5)).norm(), 1e-4) << t;
  }
  EXPECT_EQ(simulation.tool(1).held_object, "box");
  EXPECT_LT((simulation.tool(1).X_WH_proxy.matrix() - simulation.tool(1).X_WH.matrix()).norm(), 1e-9);
}

TEST(TwoHands, TwoObjectsAreHeldIndependently) {
  const auto run = [](bool second) {
    Simulation simulation(scene_of({box("a", {0.06, 0.06, 0.04}, 1.0, Vector3d(-0.05, 0, 0.5)),
                                    box("b", {0.06, 0.06, 0.04}, 2.0, Vector3d(0.05, 0, 0.5))},
                                   scene::ContactMode::none),
                          SimulationSettings());
    push_move(simulation, 0.0, 1.0, left, left + Vector3d(0.1, 0.0, 0.1), 0.5, 0);
    simulation.push_button(0.0, true, 0);
    if (second) {
      push_move(simulation, 0.0, 1.0, right, right + Vector3d(0.0, 0.2, 0.1), -0.5, 1);
      simulation.push_button(0.0, true, 1);
    }
    simulation.advance_to(1.5);
    return simulation;
  };
  const Simulation one = run(false), both = run(true);
  EXPECT_EQ(both.tool(0).held_object, "a");
  EXPECT_EQ(both.tool(1).held_object, "b");
  EXPECT_TRUE(object(one, "a").X_WO.matrix() == object(both, "a").X_WO.matrix());
  EXPECT_GT(object(both, "b").X_WO.translation().y(), 0.1);
}

TEST(TwoHands, LetGoByBothItFalls) {
  BothHold two(with_stiffness(2000.0, 500.0, 5.0));
  two.simulation.push_button(0.3, false, 0);
  two.simulation.push_button(0.4, false, 1);
  two.simulation.advance_to(0.4);
  EXPECT_FALSE(two.simulation.objects()[0].held);
  const double z = two.p().z(), v = two.simulation.objects()[0].V_WO_W.linear.z();
  two.simulation.advance_to(0.6);
  EXPECT_NEAR(two.p().z(), z + 0.2 * v - 0.5 * g * 0.04, 1e-9);
}

TEST(TwoHands, AnObjectWithoutMassIsHeldByBothAndStays) {
  scene::Scene scene = scene_of({box("box", size, 1.0, Vector3d(0, 0, 0.5))}, scene::ContactMode::none);
  scene.bodies[0].mass_properties = scene::MassProperties();
  Simulation simulation(scene, SimulationSettings());
  for (std::size_t hand = 0; hand < 2; ++hand) {
    push_move(simulation, 0.0, 1.0, hand == 0 ? left : right, (hand == 0 ? left : right) + Vector3d(0.1, 0.0, 0.1), 0.0,
              hand);
    simulation.push_button(0.0, true, hand);
  }
  simulation.advance_to(1.0);
  EXPECT_LT((simulation.objects()[0].X_WO.translation() - Vector3d(0.1, 0.0, 0.6)).norm(), 1e-5);
}

TEST(NextTool, GoesThroughAllTools) {
  Simulation simulation(scene_of({}, scene::ContactMode::none), SimulationSettings());
  simulation.push_stylus({0.0, pointing_down(left)});
  std::vector<std::string> seen;
  for (int press = 0; press < 5; ++press) {
    simulation.push_next_tool(0.01 * press);
    simulation.advance_to(0.01 * press);
    seen.push_back(validation::name_of(simulation.tool().tool));
  }
  EXPECT_EQ(seen, (std::vector<std::string>{"spring_probe", "direct", "ray", "spring", "spring_fork"}));
}

TEST(NextTool, WhileHoldingGoesThroughThoseThatHoldWithoutAJump) {
  Simulation simulation(scene_of({box("box", size, 1.0, Vector3d(0, 0, 0.5))}, scene::ContactMode::none),
                        SimulationSettings());
  push_move(simulation, 0.0, 2.0, left, left + Vector3d(0.2, 0.0, 0.0), 1.0);
  std::vector<std::string> seen;
  simulation.push_button(0.1, true);
  simulation.advance_to(0.3);
  ASSERT_EQ(simulation.tool().held_object, "box");
  seen.clear();
  for (int press = 0; press < 4; ++press) {
    const double t = 0.4 + 0.1 * press;
    simulation.advance_to(t);
    const bodies::BodyState before = simulation.objects()[0];
    simulation.push_next_tool(t);
    simulation.advance_to(t);
    simulation.advance_to(t + 1e-6);
    const bodies::BodyState& after = simulation.objects()[0];
    EXPECT_LT((after.X_WO.matrix() - before.X_WO.matrix()).norm(), 1e-5) << press;
    EXPECT_LT((after.V_WO_W.linear - before.V_WO_W.linear).norm(), 1e-3) << press;
    EXPECT_EQ(simulation.tool().held_object, "box");
    seen.push_back(validation::name_of(simulation.tool().tool));
  }
  EXPECT_EQ(seen, (std::vector<std::string>{"direct", "ray", "spring", "spring_fork"}));
}

/// Each hand calibrates its fork to what it holds, and keeps that whatever the other does; to set what is there already
/// moves nothing.
TEST(TwoHands, EachHasAForkOfItsOwn) {
  SimulationSettings set;
  set.grasp.calibrate = tools::Calibration::object;
  const Vector3d far_left(-0.5, 0.0, 0.7), far_right(0.5, 0.0, 0.7), tip(0.0, 0.0, -0.2);
  Simulation simulation(scene_of({box("heavy", size, 20.0, far_left + tip), box("light", size, 0.2, far_right + tip)},
                                 scene::ContactMode::none),
                        set);
  for (std::size_t hand = 0; hand < 2; ++hand) {
    const Vector3d p = hand == 0 ? far_left : far_right;
    push_move(simulation, 0.0, 6.0, p, p, 0.0, hand);
    simulation.push_button(0.5 * static_cast<double>(hand), true, hand);
  }
  simulation.advance_to(5.0);
  ASSERT_EQ(simulation.tool(0).held_object, "heavy");
  ASSERT_EQ(simulation.tool(1).held_object, "light");
  // k ∝ m / L, and of one size L ∝ m^(1/6).
  const double ratio = std::pow(100.0, 5.0 / 6.0);
  EXPECT_NEAR(simulation.tool(0).stiffness.stretch / simulation.tool(1).stiffness.stretch, ratio, 0.01 * ratio);
  const Vector3d heavy = object(simulation, "heavy").X_WO.translation();
  ForkChange same;
  same.damping_ratio = {1.0, 1.0, 1.0};
  simulation.change(same);
  simulation.advance_to(5.5);
  EXPECT_LT((object(simulation, "heavy").X_WO.translation() - heavy).norm(), 1e-9);
  ForkChange stiffer;
  stiffer.stiffness.stretch = 5.0 * simulation.tool(1).stiffness.stretch;
  simulation.change(stiffer, {}, 1);
  EXPECT_LT((object(simulation, "heavy").X_WO.translation() - heavy).norm(), 1e-9);
  EXPECT_NEAR(simulation.tool(0).stiffness.stretch / simulation.tool(1).stiffness.stretch, ratio / 5.0, 0.002 * ratio);
}

}  // namespace
}  // namespace spring_workbench::simulation::two_hands_test
