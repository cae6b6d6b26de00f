// Several tools on one object, and the tool spring, in one equation of motion: the laws of its integration.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"
#include "support/named.h"

namespace spring_workbench::simulation::shared_order_test {
namespace {

constexpr double sample = 0.02, duration = 1.0;
using MakeHold = std::function<Simulation(const dynamics::DynamicsSettings&, bool soft)>;

/// Motion of the hands, starting from rest; as smooth as samples at 50 Hz allow.
Vector3d swing(double time) {
  const double t = std::max(0.0, time - 0.06);
  return {0.1 * (1.0 - std::cos(6.0 * t)), 0.05 * (1.0 - std::cos(9.0 * t)), 0.05 * (1.0 - std::cos(7.0 * t))};
}

void push_swing(Simulation& simulation, const Vector3d& from, std::size_t hand, double turned = 0.0) {
  for (double t = 0.0; t < duration + 0.1; t += sample) {
    simulation.push_stylus({t, pointing_down(from + swing(t), turned * (1.0 - std::cos(5.0 * t)))}, hand);
  }
}

SimulationSettings with(const dynamics::DynamicsSettings& dynamics, const std::string& shape = "linear",
                        bool soft = false) {
  SimulationSettings set;
  set.dynamics = dynamics;
  set.fork.shape = test_support::shape_named(shape);
  set.fork.length = 0.2;
  if (!soft) return set;
  set.fork.stiffness = {40.0, 10.0, 0.1};
  set.gravity = 0.0;
  return set;
}

scene::Scene one_box(double mass) {
  return scene_of({box("box", {0.2, 0.06, 0.04}, mass, Vector3d(0, 0, 0.5))}, scene::ContactMode::none);
}

Simulation two_forks(const dynamics::DynamicsSettings& dynamics, const std::string& shape, bool soft) {
  Simulation simulation(one_box(2.0), with(dynamics, shape, soft));
  for (std::size_t hand = 0; hand < 2; ++hand) {
    push_swing(simulation, Vector3d(hand == 0 ? -0.05 : 0.05, 0, 0.7), hand, 0.1);
    simulation.push_button(0.0, true, hand);
  }
  return simulation;
}

/// Two forks and a third one, on one side of the box and at another distance from its middle.
Simulation three_forks(const dynamics::DynamicsSettings& dynamics, const std::string& shape, bool soft) {
  SimulationSettings set = with(dynamics, shape, soft);
  set.styluses = 3;
  Simulation simulation(one_box(2.0), set);
  const Vector3d from[] = {{-0.05, 0.0, 0.7}, {0.05, 0.0, 0.7}, {0.01, 0.02, 0.7}};
  for (std::size_t hand = 0; hand < 3; ++hand) {
    push_swing(simulation, from[hand], hand, 0.1);
    simulation.push_button(0.0, true, hand);
  }
  return simulation;
}

Simulation fork_and_spring(const dynamics::DynamicsSettings& dynamics, bool soft) {
  Simulation simulation = two_forks(dynamics, "linear", soft);
  simulation.advance_to(0.0);
  simulation.select_tool(tools::Tool::spring, 1);
  return simulation;
}

Simulation spring_alone(const dynamics::DynamicsSettings& dynamics, bool soft) {
  SimulationSettings set = with(dynamics, "linear", soft);
  if (soft) set.fork.damping_ratio = {0.7, 0.7, 0.7};
  set.tool = tools::Tool::spring;
  set.grasp.object = "box";
  Simulation simulation(one_box(1.0), set);
  push_swing(simulation, Vector3d(0.02, 0, 0.7), 0);
  return simulation;
}

/// A fork holds a box, and a probe of the other hand presses on its side all the time.
Simulation fork_and_probe(const dynamics::DynamicsSettings& dynamics, bool soft) {
  SimulationSettings set = with(dynamics, soft ? "bushing" : "linear", soft);
  if (soft) set.fork.stiffness = {400.0, 200.0, 2.0};  // or it would push the box off its axis
  Simulation simulation(one_box(1.0), set);
  ForkChange softer;
  softer.stiffness.stretch = soft ? 40.0 : 200.0;
  simulation.change(softer, {}, 1);
  push_swing(simulation, Vector3d(0, 0, 0.7), 0);
  simulation.push_button(0.0, true, 0);
  simulation.select_tool(tools::Tool::spring_probe, 1);
  const Quaterniond level(Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitY()));
  for (double t = 0.0; t < duration + 0.1; t += sample) {
    simulation.push_stylus({t, make_transform(Vector3d(-0.27, 0, 0.5) + swing(t), level)}, 1);
  }
  return simulation;
}

std::vector<RigidTransform> run(const MakeHold& setup, const dynamics::DynamicsSettings& dynamics, bool soft = false) {
  Simulation simulation = setup(dynamics, soft);
  std::vector<RigidTransform> poses;
  for (int i = 1; i <= std::lround(duration / sample); ++i) {
    const AdvanceReport report = simulation.advance_to(i * sample);
    EXPECT_EQ(report.steps_rejected, 0);
    poses.push_back(simulation.objects()[0].X_WO);
  }
  return poses;
}

double farthest(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, (a[i].translation() - b[i].translation()).norm());
    most = std::max(most, 0.05 * math::log_so3(a[i].linear().transpose() * b[i].linear()).norm());
  }
  return most;
}

dynamics::DynamicsSettings stepping(dynamics::IntegratorKind integrator, double step, double tolerance = 0.0) {
  dynamics::DynamicsSettings dynamics;
  dynamics.integrator = integrator;
  dynamics.step = step;
  dynamics.tolerance = tolerance;
  return dynamics;
}

std::vector<RigidTransform> reference(const MakeHold& setup, bool soft = false, double steps_per_sample = 64.0) {
  return run(setup, stepping(dynamics::IntegratorKind::exponential, sample / steps_per_sample), soft);
}

struct Case {
  std::string name;
  MakeHold setup;
  double mass = 2.0;
  bool soft = true;        ///< of which stiffness its order is looked at
  double resolved = 5e-3;  ///< from which step on [s]
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& shape : test_support::shape_names()) {
    all.push_back({"two forks, " + shape, [shape](const dynamics::DynamicsSettings& dynamics, bool soft) {
                     return two_forks(dynamics, shape, soft);
                   }});
    all.push_back({"three forks, " + shape, [shape](const dynamics::DynamicsSettings& dynamics, bool soft) {
                     return three_forks(dynamics, shape, soft);
                   }});
    if (shape == "constant") all.back().resolved = 2.5e-3;
  }
  all.push_back({"fork and spring", fork_and_spring});
  all.push_back({"fork and probe", fork_and_probe, 1.0});
  all.push_back({"spring", spring_alone, 1.0, false, 2e-2});  // the soft one is nearly linear
  return all;
}

TEST(SharedOrder, ExponentialIsOfFourOrMoreOverAnEighthOfTheStep) {
  for (const Case& c : cases()) {
    const std::vector<RigidTransform> exact = reference(c.setup, c.soft, 128.0);
    const auto error = [&](double step) {
      return farthest(run(c.setup, stepping(dynamics::IntegratorKind::exponential, step), c.soft), exact);
    };
    const double coarse = error(c.resolved), fine = error(c.resolved / 8.0);
    if (coarse < 1e-11) continue;  // a linear motion is exact
    EXPECT_GT(std::log2(coarse / fine) / 3.0, 4.0) << c.name << ": " << coarse << " to " << fine;
  }
}

TEST(SharedOrder, EveryIntegratorHasItsOwn) {
  using Kind = dynamics::IntegratorKind;
  for (const Case& c : cases()) {
    // Explicit methods would need shorter steps than these for the fast modes of a rod.
    if (c.name != "two forks, bushing" && c.name != "spring") continue;
    const std::vector<RigidTransform> exact = reference(c.setup, true);
    for (const Kind kind : {Kind::rosenbrock, Kind::rk4, Kind::implicit_euler, Kind::semi_implicit_euler}) {
      const int own = dynamics::make_integrator(kind)->order();
      const double step = own == 1 ? 1.25e-3 : kind == Kind::rosenbrock ? 1e-2 : 5e-3;
      const double coarse = farthest(run(c.setup, stepping(kind, step), true), exact);
      const double fine = farthest(run(c.setup, stepping(kind, 0.5 * step), true), exact);
      EXPECT_GT(std::log2(coarse / fine), own - 0.2) << c.name << " " << static_cast<int>(kind) << " " << coarse;
    }
  }
}

TEST(SharedOrder, IsWithinThirtyMicrometresAtTwentyMilliseconds) {
  for (const Case& c : cases()) {
    EXPECT_LT(farthest(run(c.setup, stepping(dynamics::IntegratorKind::exponential, 0.02)), reference(c.setup)), 3e-5)
        << c.name;
  }
}

TEST(SharedOrder, ASpringObeysItsTolerance) {
  const std::vector<RigidTransform> exact = reference(spring_alone);
  for (const double tolerance : {1e-4, 1e-6}) {
    const double error =
        farthest(run(spring_alone, stepping(dynamics::IntegratorKind::rosenbrock, 0.02, tolerance)), exact);
    EXPECT_LT(error, 3.0 * tolerance);
  }
}

/// Forks with dampers of given coefficients, so that they add.
SimulationSettings with_coefficients(double k, const std::string& shape) {
  SimulationSettings set = with({}, shape);
  set.fork.stiffness = {2.0 * k, k, 0.01 * k};
  set.fork.damping_law = rod::DampingLaw::coefficients;
  set.fork.damping_coefficient = {0.02 * k, 0.01 * k, 1e-4 * k};
  return set;
}

/// Poses of a box that this many hands with the same motion hold by forks.
std::vector<RigidTransform> on_one_way(const SimulationSettings& set, std::size_t hands, double second = 1.0) {
  SimulationSettings of_all = set;
  of_all.styluses = static_cast<int>(hands);
  Simulation simulation(one_box(2.0), of_all);
  for (std::size_t hand = 0; hand < hands; ++hand) {
    push_swing(simulation, Vector3d(0.03, 0.01, 0.7), hand, 0.4);
    simulation.push_button(0.0, true, hand);
  }
  if (second != 1.0) {
    ForkChange change;
    const rod::PerDof &k = set.fork.stiffness, &c = set.fork.damping_coefficient;
    change.stiffness = {second * k.stretch, second * k.bend, second * k.torsion};
    change.damping_coefficient = {second * c.stretch, second * c.bend, second * c.torsion};
    simulation.change(change, {}, 1);
  }
  std::vector<RigidTransform> poses;
  for (double t = sample; t < duration; t += sample) {
    simulation.advance_to(t);
    poses.push_back(simulation.objects()[0].X_WO);
  }
  return poses;
}

TEST(SharedLaw, ForksInOnePlaceAreOneOfAllTheirStiffness) {
  for (const std::string shape : {"linear", "bushing"}) {
    const std::vector<RigidTransform> of_one = on_one_way(with_coefficients(1200.0, shape), 1);
    for (const std::size_t n : {2u, 3u, 6u}) {
      const double k = 1200.0 / static_cast<double>(n);
      EXPECT_LT(farthest(on_one_way(with_coefficients(k, shape), n), of_one), 1e-9) << shape << n;
    }
  }
}

TEST(SharedLaw, AForkWithoutStiffnessIsNotThere) {
  for (const std::string& shape : test_support::shape_names()) {
    if (shape == "constant")
      continue;  // motions that a constant curvature cannot represent are rigid, whatever the stiffness
    const SimulationSettings set = with_coefficients(800.0, shape);
    EXPECT_LT(farthest(on_one_way(set, 2, 0.0), on_one_way(set, 1)), 1e-9) << shape;
  }
}

/// Neither hand is preferred: a box between mirrored hands stays in the plane of the mirror.
TEST(SharedLaw, MirroredHandsMoveItInTheirPlane) {
  for (const std::string shape : {"linear", "bushing"}) {
    Simulation simulation(one_box(2.0), with({}, shape));
    for (std::size_t hand = 0; hand < 2; ++hand) {
      const double side = hand == 0 ? -1.0 : 1.0;
      for (double t = 0.0; t < duration + 0.1; t += sample) {
        const Vector3d p = swing(t);
        simulation.push_stylus(
            {t, pointing_down(Vector3d(side * (0.05 + 0.1 * p.x()), p.y(), 0.7 + p.z()), side * p.y())}, hand);
      }
      simulation.push_button(0.0, true, hand);
    }
    for (double t = sample; t < duration; t += sample) {
      simulation.advance_to(t);
      const bodies::BodyState& o = simulation.objects()[0];
      ASSERT_LT(std::abs(o.X_WO.translation().x()), 1e-5) << shape;
      const Vector3d turned = math::log_so3(o.X_WO.linear());
      ASSERT_LT(std::hypot(turned.y(), turned.z()), 1e-4) << shape;
    }
    EXPECT_GT(std::abs(simulation.objects()[0].X_WO.translation().y()), 1e-2) << shape;
  }
}

/// The reported wrenches of the tools plus the weight equal the rate of momentum of the object.
TEST(SharedLaw, ReadingsOfAllToolsAreTheChangeOfMomentum) {
  for (const Case& c : cases()) {
    Simulation simulation = c.setup(stepping(dynamics::IntegratorKind::exponential, 1e-3), false);
    const auto pull = [&] {
      Vector3d sum = -c.mass * 9.81 * Vector3d::UnitZ();
      for (std::size_t hand = 0; hand < simulation.hands(); ++hand) sum += simulation.tool(hand).tip_wrench_W.force;
      return sum;
    };
    simulation.advance_to(0.2);
    Vector3d impulse = Vector3d::Zero(), before = pull();
    const Vector3d start = c.mass * simulation.objects()[0].V_WO_W.linear;
    double largest = 0.0;
    for (int i = 1; i <= 400; ++i) {
      simulation.advance_to(0.2 + 1e-3 * i);
      const Vector3d now = pull();
      impulse += 0.5e-3 * (before + now);
      before = now;
      largest = std::max(largest, impulse.norm());
    }
    EXPECT_LT((c.mass * simulation.objects()[0].V_WO_W.linear - start - impulse).norm(), 2e-3 * largest) << c.name;
  }
}

/// Integration adds no energy: the energy balance includes all hands, springs and dampers.
TEST(SharedLaw, EnergyIsAccountedFor) {
  for (const Case& c : cases()) {
    const auto added = [&](double step) {
      Simulation simulation = c.setup(stepping(dynamics::IntegratorKind::exponential, step), false);
      double sum = 0.0;
      for (double t = sample; t < duration; t += sample) sum += std::abs(simulation.advance_to(t).energy_balance);
      return sum;
    };
    const double fine = added(1e-3);
    EXPECT_LT(fine, 1e-4) << c.name;                       // of some joules that come and go
    EXPECT_LT(fine, 1e-10 + 0.3 * added(4e-3)) << c.name;  // 1e-10: rounding of 2,000 steps
  }
}

TEST(SharedLaw, GoesOnFromASavedStateBitByBit) {
  for (const Case& c : cases()) {
    for (const auto kind : {dynamics::IntegratorKind::exponential, dynamics::IntegratorKind::rosenbrock}) {
      Simulation simulation = c.setup(stepping(kind, 0.01), false);
      simulation.advance_to(0.31);
      const SimulationState saved = simulation.save();
      simulation.advance_to(0.63);
      const std::uint64_t hash = simulation.state_hash();
      simulation.restore(saved);
      EXPECT_TRUE(simulation.save() == saved) << c.name;
      simulation.advance_to(0.63);
      EXPECT_EQ(simulation.state_hash(), hash) << c.name;
      Simulation other = c.setup(stepping(kind, 0.01), false);
      other.restore(saved);
      other.advance_to(0.63);
      EXPECT_EQ(other.state_hash(), hash) << c.name;
    }
  }
}

/// Both hands press it on the bench: it stays there, and the bench carries weight and hands.
TEST(SharedLaw, TheBenchCarriesWhatBothHandsPress) {
  for (const std::string& shape : test_support::shape_names()) {
    {
      const SimulationSettings set = with({}, shape);
      Simulation simulation(
          scene_of({box("box", {0.2, 0.06, 0.04}, 2.0, Vector3d(0, 0, 0.02))}, scene::ContactMode::stop), set);
      for (std::size_t hand = 0; hand < 2; ++hand) {
        const Vector3d p(hand == 0 ? -0.05 : 0.05, 0, 0.22);
        push_move(simulation, 0.0, 0.5, p, p - Vector3d(0, 0, 0.01), 0.0, hand);
        simulation.push_button(0.0, true, hand);
      }
      simulation.advance_to(3.0);
      const bodies::BodyState& o = simulation.objects()[0];
      EXPECT_NEAR(o.X_WO.translation().z(), 0.02, 2e-5) << shape;
      EXPECT_LT(o.V_WO_W.linear.norm(), 1e-5) << shape;
      double pressed = 0.0;
      for (std::size_t hand = 0; hand < 2; ++hand) pressed -= simulation.tool(hand).tip_wrench_W.force.z();
      EXPECT_GT(pressed, 20.0) << shape;
    }
  }
}

/// Forks that only bend, pressed down: their rigid directions do not conflict, and nothing gets stuck. The DOFs that
/// are off in the follower carry their side of the box and yield only that much under the weight.
TEST(SharedLaw, WhatIsOffInBothForksSharesThePressOnTheBench) {
  for (const std::string& shape : test_support::shape_names()) {
    SimulationSettings set = with({}, shape);
    set.fork.dofs = {false, true, false};
    for (const bool press : {true, false}) {
      const double z = press ? 0.02 : 0.5;
      Simulation simulation(scene_of({box("box", {0.2, 0.06, 0.04}, 2.0, Vector3d(0, 0, z))}, scene::ContactMode::stop),
                            set);
      for (std::size_t hand = 0; hand < 2; ++hand) {
        const Vector3d p(hand == 0 ? -0.05 : 0.05, 0, z + 0.2);
        push_move(simulation, 0.0, 0.5, p, p + Vector3d(0, 0, press ? -0.01 : 0.1), 0.0, hand);
        simulation.push_button(0.0, true, hand);
      }
      const AdvanceReport report = simulation.advance_to(1.0);
      const bodies::BodyState& o = simulation.objects()[0];
      EXPECT_EQ(report.time_lost, 0.0) << shape;
      EXPECT_LT(report.collision_queries, 30 * report.steps) << shape;
      if (press) {
        EXPECT_NEAR(o.X_WO.translation().z(), 0.02, 2e-5) << shape;
      } else {
        EXPECT_LT(math::log_so3(o.X_WO.linear()).norm(), 3e-4) << shape;
      }
    }
  }
}

/// A rigid tool leads exactly, and a fork next to it is strained by that motion.
TEST(SharedLaw, ARigidToolLeadsExactly) {
  Simulation simulation = two_forks({}, "bushing", false);
  simulation.advance_to(0.0);
  const Vector3d p_SO = simulation.tool(0).X_WS.inverse() * simulation.objects()[0].X_WO.translation();
  simulation.select_tool(tools::Tool::direct, 0);
  for (double t = sample; t < duration; t += sample) {
    simulation.advance_to(t);
    if (t < 0.8) continue;  // the twist that it had goes with the DOFs that were switched off
    const RigidTransform X_WS = simulation.tool(0).X_WS;
    EXPECT_LT((X_WS * p_SO - simulation.objects()[0].X_WO.translation()).norm(), 1e-6) << t;
  }
  EXPECT_GT(simulation.tool(1).tip_wrench_W.force.norm(), 0.1);  // it is turned about the other hand's axis
}

}  // namespace
}  // namespace spring_workbench::simulation::shared_order_test
