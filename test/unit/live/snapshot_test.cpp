#include <gtest/gtest.h>

#include <cmath>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/math/spatial.h"
#include "support/bench_scenes.h"
#include "support/snapshots.h"

namespace spring_workbench::live::snapshot_test {
namespace {

constexpr double interval = 0.01;  // [s]

scene::Scene boxes(scene::ContactMode mode) {
  const Vector3d size(0.1, 0.06, 0.04);
  return scene_of({box("held", size, 1.0, {0.0, 0.0, 0.02}), box("other", size, 0.5, {0.12, 0.01, 0.02})}, mode);
}

/// A hand that carries the box back and forth over the bench, against the other box and down onto it.
HandEvents hand(int k) {
  HandEvents events;
  const double t = interval * k;
  if (k == 0) events[0].push_back(NewEpoch{});
  if (k == 1) events[0].push_back(StylusButton{t, motion::ButtonEdge::grasp});
  if (k == 250) events[0].push_back(StylusButton{t, motion::ButtonEdge::release});
  const Vector3d p(0.06 * std::sin(3.0 * t), 0.01 * std::sin(2.0 * t), 0.22 + 0.01 * std::sin(5.0 * t));
  StylusPose pose;
  pose.sample = {t, p, Quaterniond(pointing_down(p).linear())};
  pose.arrival = {t, t};
  events[0].push_back(pose);
  return events;
}

/// Everything that a node publishes about it.
template <typename Objects>
std::vector<double> readings(double time, const scene::Scene& scene, const Objects& objects,
                             const tools::ToolState& tool, const std::vector<contact::ContactState>& contacts) {
  std::vector<double> all{time, static_cast<double>(scene.bodies.size())};
  const auto add = [&all](const auto& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) all.push_back(matrix(i));
  };
  for (const bodies::BodyState& object : objects) {
    add(object.X_WO.matrix());
    add(to_vector(object.V_WO_W));
    add(Eigen::Vector4d(object.held, object.highlighted, object.in_contact, object.asleep));
  }
  for (const contact::ContactState& contact : contacts) {
    add(contact.p_W);
    add(contact.n_W);
    add(Eigen::Vector4d(contact.depth, contact.impulse, contact.force, contact.slip_speed));
    all.push_back(static_cast<double>(contact.phase));
  }
  add(tool.strain);
  add(tool.X_WH_proxy.matrix());
  add(tool.X_WE.matrix());
  add(to_vector(tool.V_WE_W));
  add(to_vector(tool.tip_wrench_W));
  add(to_vector(tool.handle_wrench_H));
  add(Eigen::Vector4d(tool.elastic_energy, tool.kinetic_energy, tool.weight, tool.load));
  return all;
}

std::vector<double> readings(const View& view) {
  return readings(view.time, *view.scene, view.objects, view.tools.front(), view.contacts);
}

TEST(Snapshot, ReadsAsTheSimulationOfItsMoment) {
  for (const scene::ContactMode mode :
       {scene::ContactMode::none, scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    SimulationRunner runner(boxes(mode), simulation::SimulationSettings(), hand_input::InputSettings(), false);
    std::vector<Committed> taken;
    std::vector<std::vector<double>> said;
    std::size_t contacts = 0;
    for (int k = 0; k < 400; ++k) {
      const double t = interval * k;
      if (k == 150) {
        Command removal;
        removal.kind = Command::Kind::edit;
        removal.edit = {simulation::ObjectEdit::Action::remove, "other", "", std::nullopt};
        runner.change("edit_object", removal);
      }
      if (k == 200) runner.undo();
      for (HandEvents events = hand(k); runner.cycle(std::exchange(events, {}), {t, t}).more;) continue;
      runner.show(0.02, {t, t}, always);
      taken.push_back(*runner.committed(always));
      runner.locked([&](const simulation::Simulation& simulation) {
        said.push_back(readings(simulation.time(), simulation.scene(), simulation.objects(), simulation.tool(),
                                simulation.contacts()));
        contacts += simulation.contacts().size();
      });
    }
    EXPECT_EQ(contacts > 0, mode != scene::ContactMode::none);
    // Long after, and in any order.
    for (const std::size_t step : {1u, 7u}) {
      for (std::size_t k = 0; k < taken.size(); k += step) {
        EXPECT_EQ(readings(taken[k].view), said[k]) << k;
        EXPECT_EQ(readings(taken[taken.size() - 1 - k].view), said[taken.size() - 1 - k]);
      }
    }
  }
}

/// Whatever the copy has done in between, and whatever was edited.
TEST(Snapshot, ACopyThatFollowsHasTheWholeState) {
  for (const scene::ContactMode mode :
       {scene::ContactMode::none, scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    simulation::Simulation committed(boxes(mode), {}), copy(boxes(mode), {});
    for (int k = 0; k < 300; ++k) {
      const double t = interval * k;
      const Vector3d p(0.06 * std::sin(3.0 * t), 0.01 * std::sin(2.0 * t), 0.22 + 0.01 * std::sin(5.0 * t));
      committed.push_stylus({t, pointing_down(p)});
      if (k == 1 || k == 150) committed.push_button(t, k == 1);
      if (k == 200) committed.edit({simulation::ObjectEdit::Action::remove, "other", "", std::nullopt});
      committed.advance_to(t);
      copy.copy_state_from(committed);
      EXPECT_TRUE(copy.save() == committed.save()) << k;
      copy.push_button(t, k % 7 < 3);
      copy.advance_to(t + 0.03);
    }
  }
}

TEST(Snapshot, ThePresentSceneHasTheObjectsWhereTheyAre) {
  scene::Scene scene = boxes(scene::ContactMode::stop);
  scene.bodies.insert(scene.bodies.begin() + 1, box("wall", Vector3d(0.1, 2.0, 1.0), 0.0, {2.0, 0.0, 0.5}));
  SimulationRunner runner(scene, simulation::SimulationSettings(), hand_input::InputSettings(), false);
  for (int k = 0; k < 100; ++k) runner.cycle(hand(k), {interval * k, interval * k});
  const View view = runner.committed(always)->view;
  const scene::Scene present = view.present_scene();
  ASSERT_EQ(present.bodies.size(), 3u);
  EXPECT_EQ(present.bodies[1].X_WO.matrix(), scene.bodies[1].X_WO.matrix());
  for (const bodies::BodyState& object : view.objects)
    EXPECT_EQ(present.bodies[*scene::find_body(present, object.name)].X_WO.matrix(), object.X_WO.matrix());
  EXPECT_NE(present.bodies[0].X_WO.matrix(), scene.bodies[0].X_WO.matrix());
}

TEST(Snapshot, IsMadeWhereItIsWanted) {
  SimulationRunner runner(boxes(scene::ContactMode::none), simulation::SimulationSettings(),
                          hand_input::InputSettings(), false);
  runner.cycle(hand(0), {0.0, 0.0});
  const auto never = [](const Progress&) { return false; };
  EXPECT_FALSE(runner.committed(never));
  EXPECT_FALSE(runner.show(0.0, {0.0, 0.0}, never));
  const Progress at = runner.committed(always)->at;
  EXPECT_TRUE(at.has_sample);
  runner.restart();
  EXPECT_TRUE(runner.committed([&](const Progress& progress) { return progress.revision > at.revision; }));
}

}  // namespace
}  // namespace spring_workbench::live::snapshot_test
