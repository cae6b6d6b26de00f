#include "spring_workbench/simulation/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/input_error.h"
#include "support/bench_scenes.h"
#include "support/named.h"

namespace spring_workbench::simulation::simulation_test {
namespace {

/// One box, 0.1 × 0.06 × 0.04 m and 1 kg, with its centre at `centre`.
scene::Scene box_scene(const Vector3d& centre, scene::ContactMode contact = scene::ContactMode::stop,
                       double friction = 0.5) {
  return scene_of({box("box", {0.1, 0.06, 0.04}, 1.0, centre, friction)}, contact, friction);
}

bool skipped(const AdvanceReport& report, const std::string& subsystem) {
  const std::vector<std::string> all = report.skipped();
  return std::find(all.begin(), all.end(), subsystem) != all.end();
}

SimulationSettings settings() { return SimulationSettings(); }

const Vector3d above(0.0, 0.0, 0.22);  // the tip of a 0.2 m fork is in the middle of a box on the bench

TEST(Simulation, BoxThatIsDroppedComesToRestOnTheBench) {
  Simulation simulation(box_scene({0.0, 0.0, 0.1}), settings());
  simulation.push_stylus({0.0, pointing_down({0.0, 0.0, 0.3})});
  simulation.push_button(0.0, true);
  simulation.push_button(0.1, false);
  for (int i = 1; i <= 200; ++i) simulation.advance_to(0.02 * i);
  const bodies::BodyState& box = simulation.objects()[0];
  EXPECT_TRUE(box.asleep);
  EXPECT_NEAR(box.X_WO.translation().z(), 0.02, 2e-5);
  EXPECT_LT(math::log_so3(box.X_WO.linear()).norm(), 0.05);
}

TEST(Simulation, ThrownObjectFliesOnAParabolaAndKeepsItsAngularMomentum) {
  SimulationSettings set = settings();
  scene::Scene scene = box_scene({0.0, 0.0, 2.0}, scene::ContactMode::none);
  Simulation simulation(scene, set);
  simulation.push_stylus({0.0, pointing_down({0.0, 0.0, 2.2})});
  push_move(simulation, 0.02, 0.5, {0.0, 0.0, 2.2}, {0.4, 0.2, 2.5}, 1.5);
  simulation.push_button(0.0, true);
  simulation.push_button(0.3, false);
  simulation.advance_to(0.3);
  const bodies::BodyState start = simulation.objects()[0];
  ASSERT_FALSE(start.held);
  ASSERT_GT(start.V_WO_W.linear.norm(), 0.3);
  const Matrix3d I = scene.bodies[0].mass_properties.inertia_O;
  const auto momentum = [&](const bodies::BodyState& s) {
    return Vector3d(s.X_WO.linear() * I * s.X_WO.linear().transpose() * s.V_WO_W.angular);
  };
  simulation.advance_to(0.5);
  const bodies::BodyState& end = simulation.objects()[0];
  const double t = 0.2;
  const Vector3d expected = start.X_WO.translation() + t * start.V_WO_W.linear - 0.5 * 9.81 * t * t * Vector3d::UnitZ();
  EXPECT_LT((end.X_WO.translation() - expected).norm(), 1e-12);
  EXPECT_LT((momentum(end) - momentum(start)).norm(), 1e-12 + 1e-9 * momentum(start).norm());
}

TEST(Simulation, AFlyingObjectStopsAtTheEndOfTheWorld) {
  for (const double height : {99.0, 101.0}) {
    Simulation simulation(box_scene({0.0, 0.0, 2.0}, scene::ContactMode::none), settings());
    simulation.place({{"box", make_transform({0.0, 0.0, height}, Quaterniond::Identity())}});
    simulation.advance_to(0.0);
    simulation.advance_to(0.5);
    const bodies::BodyState& box = simulation.objects()[0];
    EXPECT_EQ(box.asleep, height > 100.0);
    EXPECT_NEAR(box.X_WO.translation().z(), height > 100.0 ? height : height - 0.5 * 9.81 * 0.25, 0.1) << height;
  }
}

TEST(Simulation, DroppedObjectStartsFromRest) {
  SimulationSettings set = settings();
  set.grasp.release = tools::Release::dropped;
  Simulation simulation(box_scene({0.0, 0.0, 2.0}, scene::ContactMode::none), set);
  push_move(simulation, 0.0, 0.5, {0.0, 0.0, 2.2}, {0.4, 0.2, 2.5}, 1.5);
  simulation.push_button(0.0, true);
  simulation.push_button(0.3, false);
  simulation.advance_to(0.3);
  EXPECT_EQ(simulation.objects()[0].V_WO_W.linear.norm(), 0.0);
  EXPECT_EQ(simulation.objects()[0].V_WO_W.angular.norm(), 0.0);
}

TEST(Simulation, GraspDoesNotSnap) {
  Simulation simulation(box_scene({0.0, 0.0, 0.02}), settings());
  push_move(simulation, 0.0, 1.0, above + Vector3d(0.01, 0.005, 0.0), above + Vector3d(0.01, 0.005, 0.1));
  simulation.push_button(0.1, true);
  simulation.advance_to(0.1);
  const RigidTransform before = simulation.objects()[0].X_WO;
  EXPECT_TRUE(simulation.objects()[0].held);
  EXPECT_LT((before.matrix() - simulation.scene().bodies[0].X_WO.matrix()).norm(), 1e-12);
  simulation.advance_to(0.1001);
  EXPECT_LT((simulation.objects()[0].X_WO.matrix() - before.matrix()).norm(), 1e-4);
}

TEST(Simulation, LiftedBoxHangsByItsWeight) {
  Simulation simulation(box_scene({0.0, 0.0, 0.02}), settings());
  push_move(simulation, 0.0, 1.0, above, above + Vector3d(0.0, 0.0, 0.2));
  simulation.push_stylus({5.0, pointing_down(above + Vector3d(0.0, 0.0, 0.2))});
  simulation.push_button(0.0, true);
  simulation.advance_to(5.0);
  const tools::ToolState fork = simulation.tool();
  EXPECT_EQ(fork.held_object, "box");
  EXPECT_NEAR(fork.stretch, 9.81 / 2000.0, 1e-6 * 9.81 / 2000.0);
  EXPECT_NEAR(fork.tip_wrench_W.force.z(), 9.81, 1e-6);
  // Down is +z of the handle: the hand feels the weight along its fork.
  EXPECT_NEAR(fork.handle_wrench_H.force.z(), 9.81, 1e-6);
  EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), 0.22 - 9.81 / 2000.0, 1e-6);
}

TEST(Simulation, PressedOnTheBenchItStaysOutsideAndTheForkTakesUpTheDifference) {
  Simulation simulation(box_scene({0.0, 0.0, 0.02}), settings());
  push_move(simulation, 0.0, 1.0, above, above - Vector3d(0.0, 0.0, 0.03));
  simulation.push_stylus({3.0, pointing_down(above - Vector3d(0.0, 0.0, 0.03))});
  simulation.push_button(0.0, true);
  for (int i = 1; i <= 150; ++i) {
    simulation.advance_to(0.02 * i);
    EXPECT_GT(simulation.objects()[0].X_WO.translation().z(), 0.02 - 1e-5);
  }
  EXPECT_NEAR(simulation.tool().stretch, -0.03, 1e-4);
  EXPECT_TRUE(simulation.objects()[0].in_contact);
  EXPECT_LT(simulation.objects()[0].V_WO_W.linear.norm(), 1e-4);
}

TEST(Simulation, ContactsStartPersistAndEndHoweverLongACallLasts) {
  for (double call : {0.02, 0.1, 0.5}) {
    Simulation simulation(box_scene({0.0, 0.0, 0.02}), settings());
    push_move(simulation, 0.0, 1.0, above, above - Vector3d(0.0, 0.0, 0.02));
    push_move(simulation, 1.02, 2.0, above - Vector3d(0.0, 0.0, 0.02), above + Vector3d(0.0, 0.0, 0.1));
    simulation.push_button(0.0, true);
    int started = 0, ended = 0;
    bool touching = false;
    for (double t = call; t < 2.0 + 1e-9; t += call) {
      simulation.advance_to(t);
      bool starts = false, ends = false, persists = false;
      for (const contact::ContactState& c : simulation.contacts()) {
        starts = starts || c.phase == contact::ContactPhase::started;
        ends = ends || c.phase == contact::ContactPhase::ended;
        persists = persists || c.phase == contact::ContactPhase::persisting;
      }
      EXPECT_FALSE(starts && persists);
      EXPECT_EQ(persists || ends, touching) << t;
      touching = starts || persists;
      started += starts;
      ended += ends;
    }
    EXPECT_EQ(started, 1) << call;
    EXPECT_EQ(ended, 1) << call;
  }
}

TEST(Simulation, RigidForkLeavesTheHandleBehindInsteadOfPushingThrough) {
  SimulationSettings set = settings();
  set.fork.dofs = {false, false, false};
  Simulation simulation(box_scene({0.0, 0.0, 0.02}), set);
  push_move(simulation, 0.0, 1.0, above, above - Vector3d(-0.1, 0.0, 0.05));
  push_move(simulation, 1.02, 2.0, above - Vector3d(-0.1, 0.0, 0.05), above + Vector3d(0.1, 0.0, 0.1));
  simulation.push_stylus({3.0, pointing_down(above + Vector3d(0.1, 0.0, 0.1))});
  simulation.push_button(0.0, true);
  for (int i = 1; i <= 50; ++i) {
    simulation.advance_to(0.02 * i);
    EXPECT_GT(simulation.objects()[0].X_WO.translation().z(), 0.02 - 1e-5);
  }
  const tools::ToolState fork = simulation.tool();
  EXPECT_NEAR(fork.X_WH_proxy.translation().z() - fork.X_WH.translation().z(), 0.05, 2e-3);
  // The path is free again: the gap closes.
  simulation.advance_to(3.0);
  EXPECT_LT((simulation.tool().X_WH_proxy.matrix() - simulation.tool().X_WH.matrix()).norm(), 1e-9);
  EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), 0.12, 1e-6);
}

/// Pressed on the bench by a hand that trembles, through a fork that only bends: what holds it back there holds no
/// longer than the hand presses.
TEST(Simulation, ABoxPressedThroughAForkThatOnlyBendsComesAlongWhenItIsLifted) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 1e-4);
    SimulationSettings set = settings();
    set.fork.dofs = {false, true, false};
    set.fork.stiffness.bend = 80.0;
    Simulation simulation(box_scene({0.0, 0.0, 0.02}), set);
    for (int i = 0; i <= 100; ++i) {
      const double t = 0.02 * i, lifted = 0.1 * std::clamp((t - 1.0) / 0.6, 0.0, 1.0);
      const double pressed = t < 1.0 ? 2e-4 : 0.0;
      const Vector3d tremble(noise(random), noise(random), noise(random));
      simulation.push_stylus(
          {t, pointing_down(above + tremble + Vector3d(0.0, 0.0, lifted - pressed), 5.0 * noise(random))});
    }
    simulation.push_button(0.0, true);
    for (int i = 1; i <= 100; ++i) simulation.advance_to(0.02 * i);
    EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), 0.12, 2e-3) << seed;
  }
}

TEST(Simulation, WhatLiesOnAGraspedObjectWakes) {
  scene::Scene scene = box_scene({0.0, 0.0, 0.02});
  scene::Body upper = scene.bodies[0];
  upper.name = "upper";
  upper.X_WO.translation() << 0.03, 0.0, 0.06;
  scene::Body beside = upper;
  beside.name = "beside";
  beside.X_WO.translation() << 0.2, 0.0, 0.02;
  scene.bodies.push_back(upper);
  scene.bodies.push_back(beside);
  Simulation simulation(scene, settings());
  simulation.push_stylus({0.0, pointing_down(above - Vector3d(0.04, 0.0, 0.0))});
  simulation.push_button(0.0, true);
  simulation.advance_to(0.1);
  EXPECT_TRUE(simulation.objects()[0].held);
  EXPECT_FALSE(simulation.objects()[1].asleep);
  EXPECT_TRUE(simulation.objects()[2].asleep);
  EXPECT_NEAR(simulation.objects()[1].X_WO.translation().z(), 0.06, 1e-5);
}

class Switching : public testing::Test {
 protected:
  Switching() : simulation(box_scene({0.0, 0.0, 0.5}, scene::ContactMode::none), off_centre()) {
    push_move(simulation, 0.0, 2.0, {0.03, 0.02, 0.7}, {0.2, 0.1, 0.8}, 3.0);
    simulation.push_button(0.0, true);
    simulation.advance_to(0.7);
    before = simulation.objects()[0];
  }
  static SimulationSettings off_centre() {
    SimulationSettings set;
    set.fork.damping_ratio = {0.2, 0.2, 0.2};
    return set;
  }
  void expect_no_jump() {
    simulation.advance_to(0.7);
    const bodies::BodyState& after = simulation.objects()[0];
    EXPECT_LT((after.X_WO.matrix() - before.X_WO.matrix()).norm(), 1e-12);
    // Over a microsecond the object goes on by its velocity.
    simulation.advance_to(0.7 + 1e-6);
    const Vector3d moved = simulation.objects()[0].X_WO.translation() - before.X_WO.translation();
    EXPECT_LT((moved - 1e-6 * before.V_WO_W.linear).norm(), 1e-9);
    EXPECT_LT((simulation.objects()[0].V_WO_W.angular - before.V_WO_W.angular).norm(), 1e-3);
  }
  Simulation simulation;
  bodies::BodyState before;
};

ForkChange dofs_change(const rod::ForkDofs& dofs) {
  ForkChange change;
  change.dofs = {dofs.stretch, dofs.bend, dofs.torsion};
  return change;
}

TEST_F(Switching, TorsionOffAndOn) {
  ASSERT_GT(std::abs(simulation.tool().torsion), 1e-3);
  const ChangeReport off = simulation.change(dofs_change({true, true, false}));
  EXPECT_GT(off.elastic_energy_before, 0.0);
  expect_no_jump();
  simulation.advance_to(2.0);
  EXPECT_LT(std::abs(simulation.tool().torsion), 1e-9);
  const RigidTransform X = simulation.objects()[0].X_WO;
  simulation.change(dofs_change({true, true, true}));
  EXPECT_LT((simulation.objects()[0].X_WO.matrix() - X.matrix()).norm(), 1e-15);
}

TEST_F(Switching, AllOff) {
  simulation.change(dofs_change({false, false, false}));
  expect_no_jump();
  simulation.advance_to(6.0);
  EXPECT_EQ(simulation.tool().elastic_energy, 0.0);
}

TEST_F(Switching, NewStiffnessReportsTheEnergyItAdds) {
  const double torsion = simulation.tool().torsion;
  ForkChange torsion_alone;
  torsion_alone.stiffness.torsion = 15.0;
  const ChangeReport change = simulation.change(torsion_alone);
  EXPECT_NEAR(change.elastic_energy_after - change.elastic_energy_before, 0.5 * 10.0 * torsion * torsion, 1e-12);
  EXPECT_EQ(simulation.fork_settings().stiffness.bend, 500.0);
  expect_no_jump();
}

TEST_F(Switching, EveryIntegratorTakesOver) {
  for (const std::string& name : test_support::integrator_names()) {
    const dynamics::IntegratorKind kind = test_support::integrator_named(name);
    DynamicsChange change;
    change.integrator = kind;
    simulation.change({}, change);
    EXPECT_EQ(simulation.tool().integrator, kind);
    EXPECT_EQ(simulation.settings().dynamics.step, 0.02);
  }
  expect_no_jump();
}

TEST_F(Switching, DampingLaws) {
  const auto damping = [](const rod::PerDof& ratio, std::optional<rod::DampingLaw> law = std::nullopt) {
    ForkChange change;
    change.damping_ratio = {ratio.stretch, ratio.bend, ratio.torsion};
    change.damping_law = law;
    return change;
  };
  simulation.change(damping({0.5, 0.5, 0.5}, rod::DampingLaw::modal));
  EXPECT_EQ(simulation.fork_settings().damping_law, rod::DampingLaw::modal);
  expect_no_jump();
  simulation.change(damping({0.7, 0.7, 0.7}));
  EXPECT_EQ(simulation.fork_settings().damping_law, rod::DampingLaw::modal);
  EXPECT_THROW(simulation.change(damping({0.7, 0.5, 0.7})), validation::InputError);
  EXPECT_EQ(simulation.fork_settings().damping_ratio.bend, 0.7);
  simulation.change(damping({0.7, 0.5, 0.7}, rod::DampingLaw::per_dof));
  EXPECT_EQ(simulation.fork_settings().damping_ratio.bend, 0.5);
  SimulationSettings settings = simulation.settings();
  settings.fork.damping_law = rod::DampingLaw::modal;
  settings.fork.damping_ratio.bend = 0.5;
  EXPECT_THROW(Simulation(simulation.scene(), settings), validation::InputError);
}

/// Values without a law are those of the law that is in force where they are applied.
TEST_F(Switching, DampingValuesAreThoseOfTheLawInForce) {
  using Law = rod::DampingLaw;
  const auto values = [](const rod::PerDof& of, std::optional<Law> law = std::nullopt) {
    ForkChange change;
    change.damping = {of.stretch, of.bend, of.torsion};
    change.damping_law = law;
    return change;
  };
  const rod::ForkSettings& fork = simulation.fork_settings();
  const rod::PerDof small{3.0, 2.0, 0.01}, large{30.0, 20.0, 0.1}, ratio{0.2, 0.2, 0.2}, other{0.7, 0.5, 0.7};
  simulation.change(values(small, Law::coefficients));
  simulation.change(values(large));
  EXPECT_EQ(fork.damping_law, Law::coefficients);
  EXPECT_EQ(fork.damping_coefficient, large);
  EXPECT_EQ(fork.damping_ratio, ratio);
  EXPECT_EQ(simulation.tool().damping_law, Law::coefficients);
  EXPECT_EQ(simulation.tool().damping_coefficient, large);
  ForkChange soft = values(ratio, Law::modal);
  simulation.change(soft);
  soft.damping_law = std::nullopt;
  simulation.change(soft);
  EXPECT_EQ(fork.damping_law, Law::modal);
  EXPECT_EQ(fork.damping_coefficient, large);
  EXPECT_THROW(simulation.change(values(other, Law::modal)), validation::InputError);
  EXPECT_EQ(fork.damping_ratio, ratio);
  // One for each DOF: only per_dof has that. It is what the user sees in the message.
  EXPECT_NE(simulation.change(values(other)).message.find("per_dof"), std::string::npos);
  EXPECT_EQ(fork.damping_law, Law::per_dof);
  EXPECT_EQ(fork.damping_ratio, other);
  expect_no_jump();
}

TEST_F(Switching, WhatOneForkAllowsDoesNotDependOnTheOthers) {
  ForkChange modal, three;
  modal.damping_law = rod::DampingLaw::modal;
  three.damping_ratio = {0.5, 0.6, 0.7};
  simulation.change(modal, {}, 1);
  simulation.change(three, {}, 0);
  EXPECT_EQ(simulation.fork_settings(0).damping_ratio, (rod::PerDof{0.5, 0.6, 0.7}));
  EXPECT_THROW(simulation.change(three), validation::InputError);
  expect_no_jump();
}

/// Energy of the box by its own formula.
double energy_of(const Simulation& simulation) {
  const bodies::BodyState& box = simulation.objects()[0];
  const scene::MassProperties& mass = simulation.scene().bodies[0].mass_properties;
  const Matrix3d inertia_W = box.X_WO.linear() * mass.inertia_O * box.X_WO.linear().transpose();
  return 0.5 * mass.mass * box.V_WO_W.linear.squaredNorm() +
         0.5 * box.V_WO_W.angular.dot(inertia_W * box.V_WO_W.angular) + mass.mass * 9.81 * box.X_WO.translation().z();
}

TEST_F(Switching, EveryChangeReportsTheEnergyThatItAdds) {
  const double begin = energy_of(simulation), stored = simulation.tool().elastic_energy;
  ASSERT_GT(stored, 1e-3);
  EXPECT_NEAR(simulation.energy(), begin + stored, 1e-12);
  ForkChange stiffer;
  stiffer.stiffness = {4000.0, 1000.0, 10.0};  // twice the stiffness
  EXPECT_NEAR(simulation.change(stiffer).energy_added, stored, 1e-9 * stored);
  ObjectEdit heavier{ObjectEdit::Action::mass, "box", "", std::nullopt, 2.0};
  const ChangeReport twice = simulation.edit(heavier);
  EXPECT_NEAR(twice.energy_added - (twice.elastic_energy_after - twice.elastic_energy_before), begin, 1e-6);
  EXPECT_EQ(simulation.change({}, DynamicsChange{dynamics::IntegratorKind::rk4, {}, {}}).energy_added, 0.0);
  const double strained = simulation.tool().elastic_energy;
  EXPECT_NEAR(simulation.select_tool(tools::Tool::spring).energy_added, -strained, 1e-6);
  EXPECT_NEAR(simulation.energy(), energy_of(simulation) + simulation.tool().elastic_energy, 1e-12);
}

/// A law: nothing adds energy to a body in free flight.
TEST_F(Switching, TheEnergyOfAReleasedObjectStays) {
  simulation.release();
  const double thrown = simulation.energy();
  EXPECT_NEAR(thrown, energy_of(simulation), 1e-12);
  ASSERT_GT(simulation.objects()[0].V_WO_W.angular.norm(), 0.5);
  simulation.advance_to(1.2);
  EXPECT_NEAR(simulation.energy(), thrown, 1e-6 * thrown);
}

TEST(AdvanceReport, CountsOfLongRunsFit) {
  AdvanceReport day;
  day.collision_queries = 2000000000;
  AdvanceReport week;
  for (int i = 0; i < 7; ++i) week.add(day);
  EXPECT_EQ(week.collision_queries, 14000000000);
}

TEST_F(Switching, WhatIsAbsentStays) {
  ForkChange part;
  part.dofs.torsion = false;
  part.stiffness.bend = 700.0;
  part.damping_ratio.stretch = 0.5;
  EXPECT_FALSE(part.empty());
  simulation.change(part);
  const rod::ForkSettings& fork = simulation.fork_settings();
  EXPECT_EQ(fork.dofs, (rod::ForkDofs{true, true, false}));
  EXPECT_EQ(fork.stiffness, (rod::PerDof{2000.0, 700.0, 5.0}));
  EXPECT_EQ(fork.damping_ratio, (rod::PerDof{0.5, 0.2, 0.2}));
  EXPECT_TRUE(ForkChange().empty());
}

TEST_F(Switching, MessagesBeginWithTheField) {
  ForkChange change;
  change.stiffness.bend = -1.0;
  SimulationSettings settings;
  settings.fork.stiffness.bend = -1.0;
  const std::string rule = "fork.stiffness.bend: invalid value '-1': expected a number between 0 and 1e16 N/m";
  for (const auto& call : std::vector<std::function<void()>>{[&] { simulation.change(change); },
                                                             [&] { Simulation(simulation.scene(), settings); }}) {
    try {
      call();
      ADD_FAILURE();
    } catch (const validation::InputError& error) {
      EXPECT_EQ(error.what(), rule);
    }
  }
}

TEST_F(Switching, BadValuesChangeNothing) {
  const double nan = std::nan("");
  for (const double k : {nan, -1.0, 1e20}) {
    ForkChange change;  // its valid parts are not applied either
    change.stiffness.bend = 700.0;
    change.dofs = {true, false, true};
    change.stiffness.stretch = k;
    EXPECT_THROW(simulation.change(change), validation::InputError);
  }
  ForkChange damping;
  damping.damping_ratio = {0.0, 11.0, 0.0};
  EXPECT_THROW(simulation.change(damping), validation::InputError);
  for (const double step : {0.0, -1.0, nan}) {
    DynamicsChange change;
    change.integrator = dynamics::IntegratorKind::rk4;
    change.step = step;
    EXPECT_THROW(simulation.change({}, change), validation::InputError);
    ForkChange good;
    good.stiffness.bend = 700.0;
    EXPECT_THROW(simulation.change(good, change), validation::InputError);
  }
  for (const double tolerance : {-1e-6, 0.2, nan}) {
    DynamicsChange change;
    change.tolerance = tolerance;
    EXPECT_THROW(simulation.change({}, change), validation::InputError);
  }
  EXPECT_EQ(simulation.settings().dynamics.integrator, dynamics::IntegratorKind::exponential);
  EXPECT_EQ(simulation.fork_settings().stiffness.bend, 500.0);
  EXPECT_TRUE(simulation.fork_settings().dofs.bend);
  EXPECT_EQ(simulation.fork_settings().stiffness.stretch, 2000.0);
  EXPECT_EQ(simulation.fork_settings().damping_ratio.bend, 0.2);
  EXPECT_EQ(simulation.settings().dynamics.integrator, dynamics::IntegratorKind::exponential);
  expect_no_jump();
}

TEST(Simulation, EveryIntegratorReportsTheStiffestModeAndItsErrors) {
  // A pure stretch oscillator: ω = √(k/m).
  for (const std::string& name : test_support::integrator_names()) {
    SimulationSettings set = settings();
    set.dynamics.integrator = test_support::integrator_named(name);
    set.dynamics.step = 1e-3;
    set.fork.dofs = {true, false, false};
    set.fork.damping_ratio.stretch = 0.0;
    Simulation simulation(box_scene({0.0, 0.0, 1.0}, scene::ContactMode::none), set);
    push_move(simulation, 0.0, 0.2, {0.0, 0.0, 1.2}, {0.0, 0.0, 1.3});
    simulation.push_button(0.0, true);
    const AdvanceReport report = simulation.advance_to(0.1);
    EXPECT_NEAR(report.stiffest_omega_dt, 1e-3 * std::sqrt(2000.0), 1e-9) << name;
    const bool exact = name == "exponential" || name == "paper";
    EXPECT_TRUE(exact || report.position_error > 0.0) << name;
    EXPECT_LT(report.position_error, 1e-4) << name;
  }
}

TEST(Simulation, ToleranceTakesMoreStepsAndReportsThem) {
  const auto steps = [](double tolerance) {
    SimulationSettings set = settings();
    set.dynamics.integrator = dynamics::IntegratorKind::rk4;
    set.dynamics.tolerance = tolerance;
    Simulation simulation(box_scene({0.0, 0.0, 1.0}, scene::ContactMode::none), set);
    push_move(simulation, 0.0, 1.0, {0.0, 0.0, 1.2}, {0.3, 0.0, 1.3});
    simulation.push_button(0.0, true);
    const AdvanceReport report = simulation.advance_to(1.0);
    EXPECT_GT(report.substeps, 0);
    return report.steps;
  };
  EXPECT_GT(steps(1e-8), steps(1e-4));
}

TEST(Simulation, SameInputGivesTheSameBits) {
  const auto run = [] {
    Simulation simulation(box_scene({0.0, 0.0, 0.02}), settings());
    push_move(simulation, 0.0, 1.0, above, above + Vector3d(0.1, 0.05, 0.1), 1.0);
    simulation.push_button(0.1, true);
    simulation.push_button(0.8, false);
    for (int i = 1; i <= 60; ++i) simulation.advance_to(0.02 * i);
    return simulation.objects()[0].X_WO;
  };
  const RigidTransform a = run(), b = run();
  EXPECT_EQ(std::memcmp(a.data(), b.data(), 16 * sizeof(double)), 0);
}

TEST(Simulation, ARoundingErrorBetweenEndAndSampleAddsNoStep) {
  for (const double off : {-1e-15, 0.0, 1e-15}) {
    Simulation simulation(box_scene({0.0, 0.0, 0.02}), settings());
    push_move(simulation, 0.0, 1.0, above, above + Vector3d(0.1, 0.0, 0.1));
    simulation.push_button(0.0, true);
    std::int64_t steps = 0;
    for (int i = 1; i <= 50; ++i) steps += simulation.advance_to(0.02 * i + off).steps;
    EXPECT_EQ(steps, 50) << off;
    EXPECT_NEAR(simulation.time(), 1.0, 1e-12);
  }
}

TEST(Simulation, EnergyAddedIsTheIntegratorsErrorAndFallsWithTheStep) {
  const auto added = [](const char* integrator, double step) {
    SimulationSettings set = settings();
    set.dynamics.integrator = test_support::integrator_named(integrator);
    set.dynamics.step = step;
    set.fork.stiffness = {200.0, 60.0, 1.0};
    Simulation simulation(box_scene({0.0, 0.0, 1.0}, scene::ContactMode::none), set);
    push_move(simulation, 0.0, 1.0, {0.02, 0.0, 1.2}, {0.3, 0.1, 1.4}, 1.0);
    simulation.push_button(0.0, true);
    return std::abs(simulation.advance_to(1.0).energy_balance);
  };
  EXPECT_LT(added("exponential", 0.002), 1e-6);
  EXPECT_GT(added("semi_implicit_euler", 2e-4), 1e-6);  // an integrator that adds energy is detected
  EXPECT_NEAR(added("semi_implicit_euler", 2e-4) / added("semi_implicit_euler", 1e-4), 2.0, 0.3);
}

TEST(Simulation, MasslessObjectFollowsTheTipExactly) {
  scene::Scene scene = box_scene({0.0, 0.0, 0.02}, scene::ContactMode::none);
  scene.bodies[0].mass_properties = scene::MassProperties();
  Simulation simulation(scene, settings());
  push_move(simulation, 0.0, 1.0, above, above + Vector3d(0.3, 0.1, 0.2), 2.0);
  simulation.push_button(0.0, true);
  simulation.advance_to(0.5);
  const tools::ToolState fork = simulation.tool();
  EXPECT_LT((fork.X_WE.translation() - simulation.objects()[0].X_WO.translation()).norm(), 1e-12);
  EXPECT_EQ(fork.elastic_energy, 0.0);
}

TEST(Simulation, WithoutContactNoCollisionRuns) {
  Simulation simulation(box_scene({0.0, 0.0, 0.02}, scene::ContactMode::none), settings());
  push_move(simulation, 0.0, 1.0, above, above - Vector3d(0.0, 0.0, 0.1));
  simulation.push_button(0.0, true);
  const AdvanceReport report = simulation.advance_to(1.0);
  EXPECT_EQ(report.collision_queries, 0);
  EXPECT_TRUE(skipped(report, "collision"));
  EXPECT_LT(simulation.objects()[0].X_WO.translation().z(), 0.0);
}

TEST(Simulation, NothingHeldNothingStepped) {
  Simulation simulation(box_scene({0.0, 0.0, 0.02}), settings());
  push_move(simulation, 0.0, 1.0, above, above + Vector3d(0.3, 0.1, 0.2));
  EXPECT_EQ(simulation.advance_to(1.0).steps, 0);
}

SimulationSettings spring_settings(double stiffness) {
  SimulationSettings set;
  set.tool = tools::Tool::spring;
  set.fork.stiffness.stretch = stiffness;
  set.dynamics.step = 1e-3;
  return set;
}

TEST(Tools, SpringExtendsByTheWeightAndExertsNoMoment) {
  for (const double k : {200.0, 2000.0, 2e6}) {
    Simulation simulation(box_scene({0.0, 0.0, 1.0}, scene::ContactMode::none), spring_settings(k));
    simulation.push_stylus({0.0, pointing_down({0.0, 0.0, 1.2})});
    simulation.push_button(0.0, true);
    simulation.advance_to(10.0);
    const tools::ToolState tool = simulation.tool();
    EXPECT_EQ(tool.tool, tools::Tool::spring);
    EXPECT_NEAR(tool.stretch, 9.81 / k, 1e-9 * 9.81 / k);
    EXPECT_NEAR(tool.weight, 1.0, 1e-9);
    EXPECT_EQ(simulation.objects()[0].V_WO_W.angular.norm(), 0.0);
    EXPECT_EQ(tool.tip_wrench_W.moment.norm(), 0.0);
  }
}

TEST(Tools, SpringSwingsWithThePeriodOfItsPendulum) {
  Simulation simulation(box_scene({0.0, 0.0, 1.0}, scene::ContactMode::none), spring_settings(2e5));
  const double aside = 0.01;
  simulation.push_stylus({0.0, pointing_down({aside, 0.0, 1.2})});
  simulation.push_button(0.0, true);
  const double length = std::hypot(0.2, aside) + 9.81 / 2e5, angle = aside / length;
  const double period = 2.0 * 3.14159265358979323846 * std::sqrt(length / 9.81) * (1.0 + angle * angle / 16.0);
  // Ten crossings of the vertical in the same direction, the first a quarter of a period after the start.
  double before = -1.0, crossed = 0.0;
  int crossings = 0;
  for (double t = 1e-3; crossings < 10; t += 1e-3) {
    simulation.advance_to(t);
    const double x = simulation.objects()[0].X_WO.translation().x() - aside;
    if (before < 0.0 && x >= 0.0) {
      ++crossings;
      crossed = t - 1e-3 * x / (x - before);
    }
    before = x;
  }
  EXPECT_NEAR(crossed, 9.25 * period, 1e-4 * crossed);
}

/// From nothing to 300 vkg, as the paper's users had it, at a tracker's 50 Hz with its noise.
TEST(Calibrated, NoWeightAndThreeHundredKilogramsAreBothEasyToMove) {
  for (const double mass : {0.0, 1e-3, 1.0, 300.0}) {
    SimulationSettings set;
    set.grasp.calibrate = tools::Calibration::object;
    scene::Scene scene = box_scene({0.0, 0.0, 0.5}, scene::ContactMode::none);
    scene.bodies[0].mass_properties.inertia_O *= mass;
    scene.bodies[0].mass_properties.mass = mass;
    Simulation simulation(scene, set);
    const Vector3d from(0.0, 0.0, 0.7), to(0.3, 0.1, 0.8);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 1e-4);
    for (int i = 0; i <= 150; ++i) {
      const double u = std::min(i / 50.0, 1.0), s = u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
      const Vector3d jitter(noise(random), noise(random), noise(random));
      simulation.push_stylus({0.02 * i, pointing_down(from + s * (to - from) + jitter)});
    }
    simulation.push_button(0.0, true);
    int guards = 0;
    double farthest = 0.0;
    for (int i = 1; i <= 150; ++i) {
      guards += simulation.advance_to(0.02 * i).steps_rejected;
      farthest = std::max(farthest, simulation.objects()[0].X_WO.translation().x());
      const Vector3d behind =
          simulation.objects()[0].X_WO.translation() + Vector3d(0, 0, 0.2) - simulation.tool().X_WS.translation();
      EXPECT_LT(behind.head<2>().norm(), 0.1) << mass;
      if (i > 100) {
        const double sag = mass > 0.0 ? 0.1 * simulation.tool().length : 0.0;
        EXPECT_LT((simulation.objects()[0].X_WO.translation() - Vector3d(0.3, 0.1, 0.6 - sag)).norm(), 3e-3) << mass;
      }
    }
    EXPECT_LT(farthest, 0.3 + 0.03) << mass;
    EXPECT_EQ(guards, 0) << mass;
  }
}

TEST(Tools, DirectAndRayAreRigid) {
  for (const tools::Tool tool : {tools::Tool::direct, tools::Tool::ray}) {
    const std::string& name = validation::name_of(tool);
    SimulationSettings set = settings();
    set.tool = tool;
    Simulation simulation(box_scene({0.0, 0.0, 1.0}, scene::ContactMode::none), set);
    const Vector3d hand(0.01, 0.005, tool == tools::Tool::ray ? 1.5 : 1.0);
    push_move(simulation, 0.0, 1.0, hand, hand + Vector3d(0.3, 0.1, 0.2), 2.0);
    simulation.push_button(0.0, true);
    simulation.advance_to(0.0);
    ASSERT_EQ(simulation.tool().held_object, "box") << name;
    const RigidTransform X_HO = simulation.tool().X_WH.inverse() * simulation.objects()[0].X_WO;
    for (int i = 1; i <= 50; ++i) {
      simulation.advance_to(0.02 * i);
      const RigidTransform X = simulation.tool().X_WH.inverse() * simulation.objects()[0].X_WO;
      EXPECT_LT((X.matrix() - X_HO.matrix()).norm(), 1e-12) << name;
    }
  }
}

TEST_F(Switching, EveryToolTakesOverWithoutAJump) {
  for (const tools::Tool tool :
       {tools::Tool::direct, tools::Tool::spring, tools::Tool::ray, tools::Tool::spring_fork}) {
    const std::string& name = validation::name_of(tool);
    EXPECT_GE(simulation.select_tool(tool).elastic_energy_before, 0.0);
    EXPECT_EQ(simulation.tool().tool, tool);
    EXPECT_LT((simulation.objects()[0].X_WO.matrix() - before.X_WO.matrix()).norm(), 1e-9) << name;
    EXPECT_LT((simulation.objects()[0].V_WO_W.linear - before.V_WO_W.linear).norm(), 1e-9) << name;
    EXPECT_LT((simulation.objects()[0].V_WO_W.angular - before.V_WO_W.angular).norm(), 1e-9) << name;
  }
  expect_no_jump();
}

TEST(Tools, NothingIsGraspedThroughAWall) {
  scene::Scene scene = box_scene({0.0, 0.0, 0.02});
  scene::Body wall = scene.bodies[0];
  wall.name = "wall";
  wall.movable = false;
  wall.X_WO.translation().z() = 0.12;
  scene.bodies.push_back(wall);
  Simulation simulation(scene, settings());
  simulation.push_stylus({0.0, pointing_down(above)});
  simulation.push_button(0.0, true);
  simulation.advance_to(0.1);
  EXPECT_EQ(simulation.tool().held_object, "");
}

TEST(Simulation, SettingsThatDoNotFitAreRefused) {
  SimulationSettings set = settings();
  set.grasp.object = "ghost";
  EXPECT_THROW(Simulation(box_scene({0.0, 0.0, 0.02}), set), validation::InputError);
  set = settings();
  set.fork.length = 0.0;
  EXPECT_THROW(Simulation(box_scene({0.0, 0.0, 0.02}), set), validation::InputError);
}

/// The box held in the air by a hand at rest until it has come to rest itself.
class HeldAtRest : public testing::Test {
 protected:
  HeldAtRest() : simulation(box_scene({0.01, 0.0, 1.0}, scene::ContactMode::none), settings()) {
    push_move(simulation, 0.0, 0.5, {0.0, 0.0, 1.2}, {0.1, 0.0, 1.2}, 0.5);
    for (double t = 0.52; t < 8.01; t += 0.02) simulation.push_stylus({t, pointing_down({0.1, 0.0, 1.2}, 0.5)});
    simulation.push_button(0.0, true);
    simulation.advance_to(3.0);
  }
  void expect_asleep() {
    const RigidTransform before = simulation.objects()[0].X_WO;
    const AdvanceReport report = simulation.advance_to(simulation.time() + 0.1);
    EXPECT_EQ(report.steps, 0);
    EXPECT_TRUE(simulation.objects()[0].asleep);
    EXPECT_TRUE(simulation.objects()[0].held);
    EXPECT_EQ(simulation.objects()[0].V_WO_W.linear.norm(), 0.0);
    EXPECT_EQ(simulation.objects()[0].X_WO.matrix(), before.matrix());
    EXPECT_TRUE(skipped(report, "bend"));
  }
  /// It is awake over the next moment, starts from where it was, and falls asleep again somewhere else.
  void expect_awake() {
    const RigidTransform before = simulation.objects()[0].X_WO;
    EXPECT_GT(simulation.advance_to(simulation.time() + 1e-3).steps, 0);
    EXPECT_FALSE(simulation.objects()[0].asleep);
    EXPECT_LT((simulation.objects()[0].X_WO.matrix() - before.matrix()).norm(), 1e-3);
    simulation.advance_to(7.0);
    EXPECT_GT((simulation.objects()[0].X_WO.matrix() - before.matrix()).norm(), 1e-4);
    expect_asleep();
  }
  Simulation simulation;
};

TEST_F(HeldAtRest, CostsNothing) { expect_asleep(); }

TEST_F(HeldAtRest, SagsByItsWeight) {
  EXPECT_NEAR(simulation.tool().tip_wrench_W.force.z(), 9.81, 2e-5);
  EXPECT_NEAR(simulation.tool().tip_wrench_W.force.head<2>().norm(), 0.0, 2e-5);
}

TEST_F(HeldAtRest, WakesWithANewStiffness) {
  ForkChange softer;
  softer.stiffness.stretch = 500.0;
  simulation.change(softer);
  expect_awake();
}

TEST_F(HeldAtRest, WakesWithAFamilySwitchedOff) {
  simulation.change(dofs_change({false, true, true}));
  expect_awake();
}

TEST_F(HeldAtRest, WakesWithTheHand) {
  for (double t = 8.02; t < 9.01; t += 0.02) {
    simulation.push_stylus({t, pointing_down({0.1 + 0.02 * (t - 8.0), 0.0, 1.2}, 0.5)});
  }
  simulation.advance_to(7.8);
  expect_asleep();
  simulation.advance_to(7.97);
  const RigidTransform before = simulation.objects()[0].X_WO;
  simulation.advance_to(7.99);  // the motion's first velocity is that of the sample at 8 s
  EXPECT_FALSE(simulation.objects()[0].asleep);
  EXPECT_LT((simulation.objects()[0].X_WO.matrix() - before.matrix()).norm(), 1e-3);
}

TEST_F(HeldAtRest, FallsWhenItIsLetGo) {
  simulation.release();
  simulation.advance_to(simulation.time() + 0.1);
  EXPECT_FALSE(simulation.objects()[0].asleep);
  EXPECT_NEAR(simulation.objects()[0].V_WO_W.linear.z(), -0.981, 1e-9);
}

TEST(Simulation, SleeperOnABenchWakesWhenTheHandPullsItUp) {
  Simulation simulation(box_scene({0.0, 0.0, 0.02}), settings());
  push_move(simulation, 0.0, 1.0, above, above - Vector3d(0.0, 0.0, 0.01));
  for (double t = 1.02; t < 4.01; t += 0.02)
    simulation.push_stylus({t, pointing_down(above - Vector3d(0.0, 0.0, 0.01))});
  push_move(simulation, 4.02, 5.0, above - Vector3d(0.0, 0.0, 0.01), above + Vector3d(0.0, 0.0, 0.1));
  simulation.push_button(0.0, true);
  simulation.advance_to(3.5);
  EXPECT_EQ(simulation.advance_to(3.9).steps, 0);
  EXPECT_TRUE(simulation.objects()[0].asleep);
  EXPECT_TRUE(simulation.objects()[0].in_contact);
  simulation.advance_to(5.0);
  EXPECT_FALSE(simulation.objects()[0].in_contact);
  EXPECT_GT(simulation.objects()[0].X_WO.translation().z(), 0.1);
}

TEST(Simulation, SleeperFollowsAHandThatIsElsewhereAfterAGapInItsSamples) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(0.02, 0.3), turn(-1.0, 1.0);
  for (const scene::ContactMode contact :
       {scene::ContactMode::none, scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    for (int i = 0; i < 4; ++i) {
      Simulation simulation(box_scene({0.0, 0.0, 0.02}, contact), settings());
      simulation.push_stylus({0.0, pointing_down(above)});
      push_move(simulation, 0.02, 0.5, above, above + Vector3d(0.0, 0.0, 0.2), 0.5);
      simulation.push_button(0.0, true);
      simulation.advance_to(4.0);
      ASSERT_TRUE(simulation.objects()[0].held && simulation.objects()[0].asleep);
      const RigidTransform before = simulation.objects()[0].X_WO;
      RigidTransform moved = RigidTransform::Identity();  // about the vertical, so that the fork hangs as before
      moved.linear() = math::exp_so3(turn(random) * Vector3d::UnitZ());
      moved.translation() = Vector3d(shift(random), shift(random), shift(random));
      simulation.push_stylus({4.02, moved * simulation.tool().X_WH});
      simulation.advance_to(7.0);
      EXPECT_LT((simulation.objects()[0].X_WO.matrix() - (moved * before).matrix()).norm(), 1e-5) << i;
      EXPECT_TRUE(simulation.objects()[0].asleep);
    }
  }
}

TEST(Simulation, MasslessObjectFollowsTheTipExactlyAndStopsAtTheBench) {
  scene::Scene scene = box_scene({0.0, 0.0, 0.1});
  scene.bodies[0].mass_properties = scene::MassProperties();
  Simulation simulation(scene, settings());
  push_move(simulation, 0.0, 1.0, {0.0, 0.0, 0.3}, {0.3, 0.1, 0.4}, 1.0);
  push_move(simulation, 1.02, 2.0, {0.3, 0.1, 0.4}, {0.3, 0.1, 0.15}, 0.0);
  simulation.push_button(0.0, true);
  for (int i = 1; i <= 50; ++i) {
    simulation.advance_to(0.02 * i);
    const RigidTransform X_HO = simulation.tool().X_WH.inverse() * simulation.objects()[0].X_WO;
    EXPECT_LT((X_HO.translation() - Vector3d(0.0, 0.0, 0.2)).norm(), 1e-9) << i;
  }
  simulation.advance_to(2.0);
  EXPECT_NEAR(simulation.objects()[0].X_WO.translation().z(), 0.02, 1e-4);
  EXPECT_TRUE(simulation.objects()[0].in_contact);
}

TEST(Simulation, PointMassOnTheAxisDoesNotTwistAndOffItDoes) {
  const auto twist = [](double off_axis) {
    SimulationSettings set = settings();
    set.dynamics.inertia = dynamics::Inertia::point_mass;
    Simulation simulation(box_scene({off_axis, 0.0, 1.0}, scene::ContactMode::none), set);
    push_move(simulation, 0.0, 1.0, {0.0, 0.0, 1.2}, {0.3, 0.2, 1.3}, 2.0);
    simulation.push_button(0.0, true);
    double largest = 0.0;
    for (int i = 1; i <= 50; ++i) {
      simulation.advance_to(0.02 * i);
      largest = std::max(largest, std::abs(simulation.tool().torsion));
    }
    EXPECT_TRUE(std::isfinite(largest));
    return largest;
  };
  EXPECT_EQ(twist(0.0), 0.0);
  // Its own limit: the smaller the lever, the smaller the twist, without a jump to the rigid one.
  const double far = twist(0.02), near = twist(0.002);
  EXPECT_GT(far, 1e-3);
  EXPECT_LT(near, 0.2 * far);
}

}  // namespace
}  // namespace spring_workbench::simulation::simulation_test
