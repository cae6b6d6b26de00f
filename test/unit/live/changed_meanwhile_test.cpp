// A scene, also one of large meshes, is made and changed while its loop runs.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <ctime>
#include <functional>
#include <iostream>
#include <thread>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/validation/names.h"
#include "support/bench_scenes.h"
#include "support/meshes.h"
#include "support/snapshots.h"

namespace spring_workbench::live::changed_meanwhile_test {
namespace {

using simulation::ObjectEdit;
using Action = ObjectEdit::Action;

/// Balls on the bench, and the box that the hand holds.
scene::Scene balls(scene::ContactMode mode, int rings) {
  std::vector<scene::Body> bodies = {box("held", Vector3d::Constant(0.05), 1.0, {0.0, 0.0, 0.025})};
  for (int i = 0; i < 3; ++i) {
    scene::Body& ball = bodies.emplace_back(
        box("ball " + std::to_string(i), Vector3d::Constant(0.1), 1.0, Vector3d(0.3 + 0.2 * i, 0.0, 0.05)));
    ball.collision = {{test_support::sphere_mesh(0.05, rings)}};
  }
  return scene_of(bodies, mode);
}

double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// A loop in a thread of its own, with a hand that lifts the box and puts it back again and again.
class Loop {
 public:
  explicit Loop(SimulationRunner& runner) : runner_(runner), thread_([this] { run(); }) { wait_for(100); }
  ~Loop() {
    ends_ = true;
    thread_.join();
  }
  void wait_for(int more) const {
    for (const long end = cycles_ + more; cycles_ < end;) std::this_thread::yield();
  }
  long cycles() const { return cycles_; }
  /// The most processor time of a cycle since the last call [s].
  double take_longest() { return longest_.exchange(0.0); }

 private:
  void run() {
    for (int k = 0; !ends_; ++k) {
      const double t = 0.01 * k;
      HandEvents events;
      if (k == 0) events[0].emplace_back(NewEpoch{1'000'000'000});
      if (k % 100 == 3) events[0].emplace_back(StylusButton{t, motion::ButtonEdge::grasp});
      if (k % 100 == 97) events[0].emplace_back(StylusButton{t, motion::ButtonEdge::release});
      StylusPose pose;
      const Vector3d p(0.0, 0.0, 0.225 + 0.05 * (1.0 - std::cos(2.0 * M_PI * t)));
      pose.sample = {t, p, Quaterniond(pointing_down(p).linear())};
      pose.arrival = {t, t};
      events[0].emplace_back(pose);
      const double begin = processor_time();
      while (runner_.cycle(std::exchange(events, {}), {t, t}).more) continue;
      runner_.show(0.0, {t, t}, always);
      runner_.committed(always);
      longest_ = std::max<double>(longest_, processor_time() - begin);
      ++cycles_;
    }
  }

  SimulationRunner& runner_;
  std::atomic<bool> ends_{false};
  std::atomic<long> cycles_{0};
  std::atomic<double> longest_{0.0};
  std::thread thread_;
};

class ChangedMeanwhile : public testing::TestWithParam<scene::ContactMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, ChangedMeanwhile,
                         testing::Values(scene::ContactMode::stop, scene::ContactMode::dynamic),
                         [](const auto& tested) { return validation::name_of(tested.param); });

/// Everything that makes a simulation is done beside the loop: cycles go on meanwhile, and none of them makes it.
TEST_P(ChangedMeanwhile, ALargeSceneDoesNotStopTheLoop) {
  const scene::Scene scene = balls(GetParam(), 60);
  SimulationRunner runner(scene, simulation::SimulationSettings(), hand_input::InputSettings(), false,
                          Pace([] { return 0.0; }));
  double begin = processor_time();
  const simulation::Simulation alone(scene, {});
  const double to_make_one = processor_time() - begin;
  Loop loop(runner);
  const auto expect_beside = [&](const char* what, const std::function<void()>& change) {
    loop.wait_for(10);
    loop.take_longest();
    const long before = loop.cycles();
    begin = processor_time();
    change();
    const double took = processor_time() - begin;
    const long meanwhile = loop.cycles() - before;
    loop.wait_for(10);
    const double longest = loop.take_longest();
    std::cout << what << ": " << 1e3 * took << " ms, " << meanwhile << " cycles meanwhile, the longest "
              << 1e3 * longest << " ms\n";
    EXPECT_GT(meanwhile, 20) << what;
    EXPECT_LT(longest, 0.5 * to_make_one) << what;
  };
  std::cout << "to make one simulation: " << 1e3 * to_make_one << " ms\n";
  Command edit(Command::Kind::edit);
  edit.edit = {Action::mass, "ball 0", "", std::nullopt, 2.0};
  expect_beside("edit", [&] { runner.change("edit_object", edit); });
  expect_beside("undo", [&] { runner.undo(); });
  edit.edit = {Action::remove, "ball 1", "", std::nullopt};
  expect_beside("remove", [&] { runner.change("edit_object", edit); });
  expect_beside("load", [&] { runner.load(scene); });
  const auto state = runner.locked([](const auto& s) { return s.save(); });
  expect_beside("resume", [&] { runner.resume(scene, state); });
}

/// Changes by two threads while the hand grasps, and calibrates its fork to what it grasps: the journal has them in the
/// order in which they acted.
TEST_P(ChangedMeanwhile, AndReplayedBitByBit) {
  const scene::Scene scene = balls(GetParam(), 4);
  simulation::SimulationSettings settings;
  settings.grasp.calibrate = tools::Calibration::object;
  SimulationRunner runner(scene, settings, hand_input::InputSettings(), true);
  runner.keep_journal(true);
  std::vector<Entry> journal;
  const auto collect = [&] {
    for (Entry& entry : runner.take_journal()) journal.push_back(std::move(entry));
  };
  {
    Loop loop(runner);
    std::thread tuning([&] {
      for (int i = 0; i < 60; ++i) {
        Command command(Command::Kind::settings);
        const double ratio = 0.5 + 0.01 * i;
        command.fork_change.damping_ratio = {ratio, ratio, ratio};
        runner.change("live", command);
        loop.wait_for(3);
      }
    });
    for (int i = 0; i < 60; ++i) {
      Command edit(Command::Kind::edit);
      edit.edit = {Action::mass, "held", "", std::nullopt, 1.0 + 0.1 * i};
      if (i % 10 == 4) edit.edit = {Action::remove, "ball 0", "", std::nullopt};
      if (i % 10 < 5) runner.change("edit_object", edit);
      if (i % 10 == 5 || i % 10 == 6) runner.undo();
      if (i % 10 == 7) runner.restart();
      if (i % 10 == 8) runner.undo();
      if (i % 10 == 9) runner.load(scene);
      loop.wait_for(17);
      collect();
    }
    tuning.join();
  }
  runner.note_state();
  collect();
  Replayer replayer([&](const std::string&) { return scene; }, settings);
  for (const Entry& entry : journal) replayer.play(entry, [](auto&, auto&) {});
  for (const std::string& mismatch : replayer.changes().mismatches) ADD_FAILURE() << mismatch;
  EXPECT_GE(replayer.changes().repeated, 120u);
  EXPECT_EQ(replayer.changes().restored, 0u);
  EXPECT_EQ(replayer.simulation()->state_hash(), runner.locked([](const auto& s) { return s.state_hash(); }));
}

}  // namespace
}  // namespace spring_workbench::live::changed_meanwhile_test
