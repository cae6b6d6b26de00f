// Edits and resets of a live run, and undo.
#include <gtest/gtest.h>

#include <functional>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/validation/input_error.h"
#include "support/bench_scenes.h"
#include "support/snapshots.h"

namespace spring_workbench::live::undo_test {
namespace {

using simulation::ObjectEdit;
using Action = ObjectEdit::Action;

const Vector3d handle(0.0, 0.0, 0.25);

scene::Scene two_cubes() {
  const Vector3d size = Vector3d::Constant(0.1);
  scene::Scene scene = scene_of({box("held", size, 1.0, {0.0, 0.0, 0.05}), box("other", size, 1.0, {1.0, 0.0, 0.05})},
                                scene::ContactMode::stop);
  scene.targets["other"] = {};
  return scene;
}

ObjectEdit new_mass(double mass) { return {Action::mass, "held", "", std::nullopt, mass}; }
ObjectEdit removal(const std::string& name) { return {Action::remove, name, "", std::nullopt}; }

/// A hand that holds a cube, and lifts it by up to 0.2 m.
struct Bench {
  SimulationRunner runner{two_cubes(), simulation::SimulationSettings(), hand_input::InputSettings(), false};
  int k = 0;
  Shown shown;

  void continue_with(int samples) {
    for (const int end = k + samples; k < end; ++k) {
      const double t = 0.01 * k;
      HandEvents events;
      if (k == 0) events[0].push_back(NewEpoch{});
      if (k % 300 == 1) events[0].push_back(StylusButton{t, motion::ButtonEdge::grasp});
      if (k % 300 == 250) events[0].push_back(StylusButton{t, motion::ButtonEdge::release});
      StylusPose pose;
      const RigidTransform X =
          pointing_down(handle + 0.1 * (1.0 - std::cos(0.02 * M_PI / 3.0 * k)) * Vector3d::UnitZ());
      pose.sample = {t, X.translation(), Quaterniond(X.linear())};
      pose.arrival = {t, t};
      events[0].push_back(pose);
      while (runner.cycle(std::exchange(events, {}), {t, t}).more) continue;
      const std::int64_t shown_until = shown.at.stamp;
      shown = *runner.show(0.0, {t, t}, always);
      EXPECT_GE(shown.at.stamp, shown_until);
    }
  }
  std::size_t placements() const { return runner.committed(always)->placements.size(); }
  double mass() const {
    return runner.locked([](const auto& s) { return s.scene().bodies[0].mass_properties.mass; });
  }
  std::vector<bodies::BodyState> objects() const {
    return runner.locked([](const auto& s) { return s.objects(); });
  }
  double time() const {
    return runner.locked([](const auto& s) { return s.time(); });
  }
  void edit(const ObjectEdit& edit) {
    Command command;
    command.kind = Command::Kind::edit;
    command.edit = edit;
    runner.change("edit_object", command);
  }
};

TEST(Undo, PutsObjectsAndMassesWhereTheyWereAndTimeGoesOn) {
  Bench bench;
  bench.continue_with(120);
  ASSERT_TRUE(bench.objects()[0].held);
  const std::vector<bodies::BodyState> lifted = bench.objects();
  bench.edit(removal("held"));
  ASSERT_EQ(bench.objects().size(), 1u);
  EXPECT_EQ(bench.placements(), 1u);
  bench.edit(removal("other"));
  EXPECT_EQ(bench.placements(), 0u);
  bench.continue_with(30);
  const double now = bench.time();
  EXPECT_EQ(bench.runner.undo().message, "removed other");
  EXPECT_EQ(bench.objects().size(), 1u);
  EXPECT_EQ(bench.runner.undo().message, "removed held");
  EXPECT_EQ(bench.time(), now);
  ASSERT_EQ(bench.objects().size(), 2u);
  EXPECT_EQ(bench.placements(), 1u);
  for (int i : {0, 1}) EXPECT_EQ(bench.objects()[i].X_WO.matrix(), lifted[i].X_WO.matrix());
  EXPECT_FALSE(bench.objects()[0].held);
  bench.continue_with(100);
  EXPECT_GT(bench.time(), now);
  EXPECT_NEAR(bench.objects()[0].X_WO.translation().z(), 0.05, 1e-4);  // has fallen
  EXPECT_EQ(bench.shown.view.objects.size(), 2u);
  EXPECT_THROW(bench.runner.undo(), validation::InputError);
}

TEST(Undo, TakesAResetBack) {
  Bench bench;
  bench.continue_with(120);
  const RigidTransform lifted = bench.objects()[0].X_WO;
  bench.runner.restart();
  EXPECT_EQ(bench.objects()[0].X_WO.translation().z(), 0.05);
  bench.continue_with(5);
  EXPECT_EQ(bench.runner.undo().message, "reset");
  EXPECT_EQ(bench.objects()[0].X_WO.matrix(), lifted.matrix());
}

/// The hand is not part of what is taken back: its samples continue, and so does the clutch with its offset.
TEST(Undo, KeepsTheHandItsClutchAndItsTime) {
  Bench bench;
  Command clutch(Command::Kind::clutch);
  const auto switch_clutch = [&](bool on) {
    clutch.on = on;
    bench.runner.change("clutch", clutch);
    bench.continue_with(3);
  };
  const auto tool = [&] { return bench.runner.locked([](const auto& s) { return s.tool(); }); };
  bench.continue_with(60);
  bench.edit(new_mass(2.0));
  switch_clutch(true);
  const RigidTransform stays = tool().X_WS;
  const std::int64_t shown = bench.shown.at.stamp;
  const double now = bench.time();
  bench.runner.undo();
  EXPECT_EQ(bench.time(), now);
  const std::optional<Shown> at_once = bench.runner.show(0.0, {now, now}, always);
  EXPECT_TRUE(!at_once || at_once->at.stamp >= shown);
  EXPECT_TRUE(tool().clutch);
  bench.continue_with(60);
  EXPECT_EQ(tool().X_WS.matrix(), stays.matrix());
  bench.edit(new_mass(2.0));
  switch_clutch(false);
  const auto offset = [&] {
    const double k = 100.0 * bench.time();
    return tool().X_WS.translation().z() - 0.25 - 0.1 * (1.0 - std::cos(0.02 * M_PI / 3.0 * k));
  };
  const double before = offset();
  ASSERT_GT(std::abs(before), 0.01);
  bench.runner.undo();
  EXPECT_NEAR(offset(), before, 1e-9);
  bench.continue_with(30);
  EXPECT_NEAR(offset(), before, 1e-4);
}

TEST(Undo, UndoesTheDocumentedNumberOfEdits) {
  Bench bench;
  for (int i = 1; i <= 25; ++i) bench.edit(new_mass(i));
  for (int i = 24; i >= 5; --i) {
    bench.runner.undo();
    EXPECT_EQ(bench.mass(), i);
  }
  EXPECT_THROW(bench.runner.undo(), validation::InputError);
  EXPECT_EQ(bench.mass(), 5.0);
  EXPECT_THROW(bench.edit(new_mass(-1.0)), validation::InputError);
  EXPECT_THROW(bench.runner.undo(), validation::InputError);  // what was refused is no edit
  bench.edit(new_mass(7.0));
  bench.runner.load(two_cubes());
  EXPECT_THROW(bench.runner.undo(), validation::InputError);
}

TEST(Undo, AndEditsAreReplayedFromTheJournalBitByBit) {
  Bench bench;
  std::vector<Entry> journal;
  const auto continue_with = [&](int samples) {
    bench.continue_with(samples);
    bench.runner.note_state();
    for (Entry& entry : bench.runner.take_journal()) journal.push_back(entry);
  };
  continue_with(20);
  bench.runner.keep_journal(true);
  continue_with(80);
  bench.edit(new_mass(2.5));
  continue_with(80);
  bench.edit(removal("other"));
  continue_with(150);
  bench.runner.restart();
  continue_with(60);
  bench.runner.undo();
  continue_with(90);
  bench.runner.undo();
  continue_with(200);
  Replayer replayer([](const std::string&) { return two_cubes(); }, simulation::SimulationSettings());
  for (const Entry& entry : journal) replayer.play(entry, [](auto&, auto&) {});
  EXPECT_TRUE(replayer.changes().mismatches.empty());
  EXPECT_EQ(replayer.changes().repeated, 5u);
  EXPECT_EQ(replayer.changes().restored, 0u);
  EXPECT_EQ(replayer.simulation()->objects().size(), 2u);
  EXPECT_EQ(replayer.simulation()->state_hash(), bench.runner.locked([](const auto& s) { return s.state_hash(); }));
}

/// Of every change, also of those that replace the whole state: the difference of the energies before and after it.
TEST(Energy, EveryLiveChangeReportsWhatItAdds) {
  Bench bench;
  const auto energy = [&] { return bench.runner.locked([](const auto& s) { return s.energy(); }); };
  const auto adds = [&](const char* what, double expected, const std::function<ChangeReport()>& change) {
    const double before = energy();
    const ChangeReport report = change();
    EXPECT_NEAR(report.energy_added, energy() - before, 1e-12) << what;
    EXPECT_NEAR(report.energy_added, expected, 1e-6) << what;
  };
  const auto make = [&](Command::Kind kind) { return bench.runner.change("test", Command(kind)); };
  bench.continue_with(120);
  const double strain = bench.runner.locked([](const auto& s) { return s.tool().elastic_energy; });
  ASSERT_GT(strain, 1e-3);
  adds("settings", 0.0, [&] { return make(Command::Kind::settings); });
  adds("clutch", 0.0, [&] { return make(Command::Kind::clutch); });
  adds("release", -strain, [&] { return make(Command::Kind::release); });
  const double lifted = energy(), at_rest = 2.0 * 9.81 * 0.05;  // two cubes of 1 kg on the bench
  const Vector3d place = bench.objects()[0].X_WO.translation();
  adds("reset", at_rest - lifted, [&] { return bench.runner.restart(); });
  const double potential = 9.81 * place.z() + 0.5 * at_rest;  // undone: there, and at rest
  adds("undo", potential - at_rest, [&] { return bench.runner.undo(); });
  adds("load", at_rest - potential, [&] { return bench.runner.load(two_cubes()); });
}

/// A restarted node has the edits.
TEST(Undo, AResumedSceneIsTheEditedOne) {
  Bench bench;
  bench.continue_with(120);
  bench.edit(removal("other"));
  bench.edit(new_mass(2.5));
  const auto state = bench.runner.locked([](const auto& s) { return s.save(); });
  Bench another;
  another.runner.resume(two_cubes(), state);
  another.continue_with(3);
  ASSERT_EQ(another.objects().size(), 1u);
  EXPECT_EQ(another.mass(), 2.5);
}

}  // namespace
}  // namespace spring_workbench::live::undo_test
