#include "spring_workbench/live/pace.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "spring_workbench/live/fair_mutex.h"
#include "spring_workbench/live/simulation_runner.h"
#include "support/bench_scenes.h"
#include "support/snapshots.h"

namespace spring_workbench::live::pace_test {
namespace {

std::int64_t stamp_of(const SimulationRunner& runner) { return runner.committed(always)->at.stamp; }

TEST(Pace, IsBehindIfAcceptedSamplesAreNotSimulatedSoon) {
  Pace quick, slow;
  for (int k = 0; k < 50; ++k) {
    quick.committed(0.01, 0.001, 4.0);  // a process that was stopped: 0.4 s of work
    slow.committed(0.01, 0.1, 0.45);    // ten times slower than the hand, and not far behind
  }
  EXPECT_FALSE(quick.is_behind());
  EXPECT_FALSE(slow.is_behind());
  EXPECT_TRUE(quick.can_look_ahead(0.5));
  EXPECT_FALSE(quick.can_look_ahead(2.0));
  slow.committed(0.01, 0.1, 0.55);
  EXPECT_TRUE(slow.is_behind());
  slow.committed(0.01, 0.1, 0.02);
  EXPECT_TRUE(slow.is_behind());
  slow.caught_up();
  EXPECT_FALSE(slow.is_behind());
  Pace turns;  // after a while it is known to be fast again
  for (int k = 0; k < 50; ++k) turns.committed(0.01, 0.1, 0.0);
  for (int k = 0; k < 50; ++k) turns.committed(0.01, 0.001, 0.0);
  EXPECT_TRUE(turns.can_look_ahead(0.5));
}

/// With a backlog of three seconds of samples and more arriving, the display is far ahead of the committed state and
/// takes correspondingly long; the committed state still catches up, and the display is updated at least ten times a
/// second.
TEST(ShowTimes, LookingFarAheadDoesNotPreventCatchingUp) {
  for (const double period : {1e-3, 0.01}) {
    for (const double cost : {0.05, 0.2, 0.4}) {  // [s] for simulating one second
      const double step = 0.005;                  // [s] between samples
      ShowTimes times(period);
      double now = 3.0, committed = 0.0, shown = 3.0;
      while (now - committed > step && now < 60.0) {
        now += cost * step;
        committed += step;
        if (!times.due(now)) continue;
        const double began = now;
        now += std::min(cost * (now - committed), 0.1);
        times.shown(began, now);
        EXPECT_LT(now - shown, 0.25);
        shown = now;
      }
      EXPECT_LT(now, 3.0 + 3.0 * cost / (0.5 - cost)) << period << ' ' << cost;
    }
  }
}

/// A thread that locks repeatedly lets another have its turn.
TEST(FairMutex, NobodyWaitsForMoreThanOneTurn) {
  FairMutex mutex;
  std::atomic<bool> stop{false};
  std::atomic<int> turns{0};
  std::thread greedy([&] {
    while (!stop) {
      const std::lock_guard<FairMutex> lock(mutex);
      ++turns;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  while (turns < 3) std::this_thread::yield();
  int most = 0;
  for (int k = 0; k < 20; ++k) {
    const int before = turns;
    const std::lock_guard<FairMutex> lock(mutex);
    most = std::max(most, turns - before);
  }
  stop = true;
  greedy.join();
  EXPECT_LE(most, 2);  // the one under way, and one that asked before this thread did
}

/// A step of 1 µs while an object is held: simulated time slows down, every call is answered within a few cycles, and
/// nothing is lost.
TEST(Pace, AStepThatCannotKeepUpLosesNothing) {
  const Vector3d grip(0.0, 0.0, 0.7);
  SimulationRunner runner(
      scene_of({box("box", Vector3d(0.1, 0.06, 0.04), 1.0, grip + Vector3d(0.0, 0.0, -0.2))}, scene::ContactMode::none),
      simulation::SimulationSettings(), hand_input::InputSettings(), false);
  const auto set = [&](dynamics::IntegratorKind kind, double step) {
    Command command;
    command.kind = Command::Kind::settings;
    command.dynamics_change.integrator = kind;
    command.dynamics_change.step = step;
    runner.change("set_integrator", command);
  };
  const auto begin = std::chrono::steady_clock::now();
  const auto now = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  std::atomic<bool> stop{false};
  std::atomic<int> cycles{0}, behind{0};
  double time_skipped = 0.0;
  std::thread loop([&] {
    int sent = 0;
    while (!stop) {
      HandEvents events;
      for (; 0.01 * sent <= now(); ++sent) {
        const double t = 0.01 * sent;
        if (sent == 0) events[0].emplace_back(NewEpoch{1'000'000'000});
        StylusPose pose;
        const Vector3d p = grip + Vector3d(0.1 * std::sin(3.0 * t), 0.0, 0.0);
        pose.sample = {t, p, Quaterniond(pointing_down(p).linear())};
        pose.arrival = {now(), now()};
        events[0].emplace_back(pose);
        if (sent == 1) events[0].emplace_back(StylusButton{t, motion::ButtonEdge::grasp});
      }
      const CycleReport report = runner.cycle(events, {now(), now()});
      runner.show(0.0, {now(), now()}, always);
      ++cycles;
      behind += report.behind ? 1 : 0;
      time_skipped += report.time_skipped;
      if (!report.more) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  const auto held = [&] { return runner.locked([](const auto& s) { return s.objects()[0].held; }); };
  while (now() < 60.0 && !held()) std::this_thread::yield();
  set(dynamics::IntegratorKind::rk4, 1e-6);
  int longest = 0;
  while (now() < 60.0 && behind < 3) {
    const int before = cycles;
    EXPECT_TRUE(held());
    longest = std::max(longest, cycles - before);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_GE(behind, 3);
  EXPECT_LE(longest, 3);
  set(dynamics::IntegratorKind::exponential, 0.01);
  // It catches up with the hand.
  const auto lag = [&] { return now() - 1e-9 * static_cast<double>(stamp_of(runner) - 1'000'000'000); };
  while (now() < 90.0 && !(lag() < 0.1)) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_LT(lag(), 1.0);
  EXPECT_TRUE(held());
  stop = true;
  loop.join();
  EXPECT_GT(time_skipped, 0.0);
}

/// Before a step, while an object is held and after a change, with and without a time scale: a step lasts as long as
/// set, takes what the clock says, and changes neither the committed state nor what is shown.
TEST(Pace, AStepIsMeasuredWithoutChangingAnything) {
  const Vector3d grip(0.0, 0.0, 0.7);
  simulation::SimulationSettings settings;
  settings.hand_time_scale = 0.5;
  double ticks = 0.0;
  SimulationRunner runner(
      scene_of({box("box", Vector3d(0.1, 0.06, 0.04), 1.0, grip + Vector3d(0.0, 0.0, -0.2))}, scene::ContactMode::none),
      settings, hand_input::InputSettings(), false, Pace([&] { return ticks += 0.25; }));
  const auto hash = [&] { return runner.locked([](const auto& s) { return s.state_hash(); }); };
  for (int k = 0; k < 50; ++k) {
    const double t = 0.01 * k;
    HandEvents events;
    if (k == 0) events[0].emplace_back(NewEpoch{1'000'000'000});
    StylusPose pose;
    const Vector3d p = grip + Vector3d(0.1 * std::sin(20.0 * t), 0.0, 0.0);
    pose.sample = {t, p, Quaterniond(pointing_down(p).linear())};
    pose.arrival = {t, t};
    events[0].emplace_back(pose);
    if (k == 1) events[0].emplace_back(StylusButton{t, motion::ButtonEdge::grasp});
    while (runner.cycle(events, {t, t}).more) events.clear();
    Command command;
    command.kind = Command::Kind::settings;
    command.dynamics_change.step = k % 2 == 0 ? 1e-6 : 0.004;
    if (k % 5 == 0) runner.change("set_integrator", command);
    const std::uint64_t before = hash();
    const std::optional<Shown> shown = runner.show(0.0, {t, t}, always);
    const StepTime step = runner.time_of_step();
    EXPECT_EQ(step.lasts, runner.locked([](const auto& s) { return s.settings().dynamics.step; }) / 0.5);
    EXPECT_EQ(step.takes, 0.25);
    EXPECT_EQ(hash(), before);
    const std::optional<Shown> again = runner.show(0.0, {t, t}, always);
    EXPECT_EQ(again->view.time, shown->view.time);
    EXPECT_EQ(again->view.objects[0].X_WO.matrix(), shown->view.objects[0].X_WO.matrix());
  }
  EXPECT_TRUE(runner.locked([](const auto& s) { return s.objects()[0].held; }));
}

TEST(Pace, ACycleCommitsWhatItCanSimulateInTime) {
  Pace pace;
  EXPECT_EQ(pace.end_of_cycle(1.0, 3.0, 0.01), 3.0);  // nothing is known yet
  pace.committed(0.01, 0.02, 0.0);
  EXPECT_EQ(pace.end_of_cycle(1.0, 1.049, 0.01), 1.049);
  EXPECT_NEAR(pace.end_of_cycle(1.0, 1.06, 0.02), 1.04, 1e-12);
  EXPECT_NEAR(pace.end_of_cycle(1.0, 3.0, 0.1), 1.1, 1e-12);
  EXPECT_EQ(pace.end_of_cycle(1.0, 1.06, 0.1), 1.06);
  pace.changed();
  EXPECT_NEAR(pace.end_of_cycle(1.0, 3.0, 1e-6), 1.000001, 1e-12);
  EXPECT_FALSE(pace.can_look_ahead(1e-3));
  pace.committed(1e-6, 1e-9, 0.0);  // not averaged with what was before
  EXPECT_EQ(pace.end_of_cycle(1.0, 100.0, 1e-6), 100.0);
  EXPECT_TRUE(pace.can_look_ahead(1.0));
}

/// A hand that shakes a box, falls silent and comes back, with steps of 2 ms. `tick`: time that a cycle seems to take
/// [s].
struct ShakenBox {
  explicit ShakenBox(double tick)
      : runner(scene, simulation::SimulationSettings(), hand_input::InputSettings(), false,
               Pace([tick, ticks = 0.0]() mutable { return ticks += tick; })) {
    runner.keep_journal(true);
    Command command(Command::Kind::settings);
    command.dynamics_change.step = 2e-3;
    runner.change("set_integrator", command);
  }
  /// Simulates three seconds; `after_cycle(progress)` is called after each cycle.
  void run(const std::function<void(const Progress&)>& after_cycle) {
    for (int k = 0; k < 300; ++k) {
      const double t = 0.01 * k;
      HandEvents events;
      StylusPose pose;
      const Vector3d p = grip + Vector3d(0.1 * std::sin(20.0 * t), 0.0, 0.0);
      pose.sample = {t, p, Quaterniond(pointing_down(p).linear())};
      pose.arrival = {t, t};
      if (k == 0) events[0].emplace_back(NewEpoch{1'000'000'000});
      if (k < 100 || k > 200) events[0].emplace_back(pose);
      if (k == 1) events[0].emplace_back(StylusButton{t, motion::ButtonEdge::grasp});
      for (bool more = true; more; events.clear()) {
        more = runner.cycle(events, {t, t}).more;
        after_cycle(runner.committed(always)->at);
      }
    }
    EXPECT_TRUE(runner.locked([](const auto& s) { return s.objects()[0].held; }));
  }
  std::uint64_t hash() const {
    return runner.locked([](const auto& s) { return s.state_hash(); });
  }

  const Vector3d grip = Vector3d(0.0, 0.0, 0.7);
  const scene::Scene scene =
      scene_of({box("box", Vector3d(0.1, 0.06, 0.04), 1.0, grip + Vector3d(0.0, 0.0, -0.2))}, scene::ContactMode::none);
  SimulationRunner runner;
};

/// How far one cycle gets depends on the clock, but neither the steps nor the times that count as committed do.
TEST(Pace, StepsDoNotDependOnHowLongACycleTakes) {
  std::vector<std::vector<std::int64_t>> committed;
  std::vector<std::uint64_t> ends;
  for (const double tick : {0.0, 0.2}) {
    ShakenBox shaken(tick);
    int interrupted = 0;
    committed.emplace_back();
    shaken.run([&](const Progress& at) {
      interrupted += at.is_interrupted ? 1 : 0;
      if (!at.is_interrupted && at.began) committed.back().push_back(at.stamp);
    });
    ends.push_back(shaken.hash());
    std::cout << committed.back().size() << " times, " << interrupted << " cycles ended before one\n";
    EXPECT_EQ(interrupted > 500, tick > 0.0);
  }
  EXPECT_EQ(ends[1], ends[0]);
  const std::set<std::int64_t> quick(committed[0].begin(), committed[0].end());
  const auto silence = [](std::int64_t stamp) { return stamp > 1'990'000'000 && stamp < 3'010'000'000; };
  for (const std::int64_t stamp : committed[1]) EXPECT_TRUE(silence(stamp) || quick.count(stamp) == 1u) << stamp;
}

/// Changes take effect between two cycles, also on the way to a sample, and the replayed journal leads to the same
/// bits.
TEST(Pace, AChangeBetweenTwoStepsIsReplayed) {
  ShakenBox shaken(0.2);
  int cycles = 0, on_the_way = 0;
  shaken.run([&](const Progress& at) {
    if (++cycles % 17 != 0) return;
    on_the_way += at.is_interrupted ? 1 : 0;
    Command command(Command::Kind::settings);
    command.dynamics_change.step = cycles % 2 == 0 ? 2e-3 : 1.7e-3;
    shaken.runner.change("set_integrator", command);
    shaken.runner.note_state();
  });
  EXPECT_GT(on_the_way, 30);
  Replayer replayer{[&](const std::string&) { return shaken.scene; }, {}};
  for (const Entry& entry : shaken.runner.take_journal()) replayer.play(entry, [](auto&, auto&) {});
  EXPECT_TRUE(replayer.changes().mismatches.empty());
  shaken.runner.note_state();
  for (const Entry& entry : shaken.runner.take_journal()) replayer.play(entry, [](auto&, auto&) {});
  EXPECT_EQ(replayer.simulation()->state_hash(), shaken.hash());
}

/// A hand that shakes an object falls silent, and each step takes a microsecond: the silence is simulated in parts, and
/// the replayed journal leads to the same bits.
TEST(Pace, ASilenceThatCannotBeSimulatedInTimeKeepsNobodyWaiting) {
  const Vector3d grip(0.0, 0.0, 0.7);
  const scene::Scene scene =
      scene_of({box("box", Vector3d(0.1, 0.06, 0.04), 1.0, grip + Vector3d(0.0, 0.0, -0.2))}, scene::ContactMode::none);
  SimulationRunner runner(scene, simulation::SimulationSettings(), hand_input::InputSettings(), false);
  runner.keep_journal(true);
  const auto cycle = [&](const HandEvents& events, double now) { return runner.cycle(events, {now, now}); };
  double t = 0.0;
  for (int k = 0; k < 50; ++k) {
    t = 0.01 * k;
    HandEvents events;
    if (k == 0) events[0].emplace_back(NewEpoch{1'000'000'000});
    StylusPose pose;
    const Vector3d p = grip + Vector3d(0.1 * std::sin(20.0 * t), 0.0, 0.0);
    pose.sample = {t, p, Quaterniond(pointing_down(p).linear())};
    pose.arrival = {t, t};
    events[0].emplace_back(pose);
    if (k == 1) events[0].emplace_back(StylusButton{t, motion::ButtonEdge::grasp});
    while (cycle(events, t).more) events.clear();
  }
  EXPECT_TRUE(runner.locked([](const auto& s) { return s.objects()[0].held; }));
  Command command;
  command.kind = Command::Kind::settings;
  command.dynamics_change.integrator = dynamics::IntegratorKind::rk4;
  command.dynamics_change.step = 1e-6;
  runner.change("set_integrator", command);
  const double silent_since = runner.locked([](const auto& s) { return s.time(); });
  double longest = 0.0;                          // simulated by one cycle [s]
  for (int cycles = 0; cycles < 20; ++cycles) {  // half a second of silence at once, and more
    const CycleReport report = cycle({}, t + 0.6 + 0.05 * cycles);
    longest = std::max(longest, report.advance.simulated_time);
  }
  const double simulated = runner.locked([](const auto& s) { return s.time(); }) - silent_since;
  std::cout << "simulated " << simulated << " s, a cycle at most " << longest << " s\n";
  EXPECT_GT(simulated, 0.0);
  EXPECT_LT(longest, 0.1);  // in one go it would be the half second
  Replayer replayer{[&](const std::string&) { return scene; }, {}};
  for (const Entry& entry : runner.take_journal()) replayer.play(entry, [](auto&, auto&) {});
  runner.note_state();
  for (const Entry& entry : runner.take_journal()) replayer.play(entry, [](auto&, auto&) {});
  EXPECT_EQ(replayer.simulation()->state_hash(), runner.locked([](const auto& s) { return s.state_hash(); }));
}

/// A scene with many objects is built concurrently with the cycles and swapped in between two of them.
TEST(Pace, AScenesMakingKeepsNoCycleWaiting) {
  std::vector<scene::Body> many;
  for (int k = 0; k < 10000; ++k) {
    many.push_back(box("box " + std::to_string(k), Vector3d(0.02, 0.02, 0.02), 1.0, Vector3d(0.1 * k, 0.0, 0.5)));
  }
  const scene::Scene large = scene_of(many, scene::ContactMode::none);
  SimulationRunner runner(scene_of({many.front()}, scene::ContactMode::none), simulation::SimulationSettings(),
                          hand_input::InputSettings(), false);
  std::atomic<bool> loading{true};
  std::thread loader([&] {
    runner.load(large);
    loading = false;
  });
  int meanwhile = 0;
  for (double t = 0.0; loading; t += 0.01) {
    HandEvents events;
    StylusPose pose;
    pose.sample = {t, Vector3d(0.0, 0.0, 0.7), Quaterniond(pointing_down(Vector3d(0.0, 0.0, 0.7)).linear())};
    pose.arrival = {t, t};
    if (meanwhile == 0) events[0].emplace_back(NewEpoch{1'000'000'000});
    events[0].emplace_back(pose);
    EXPECT_LE(runner.cycle(events, {t, t}).rejected[0].size(), 0u);
    ++meanwhile;
  }
  loader.join();
  EXPECT_GT(meanwhile, 5);  // one, where making held the lock
  EXPECT_EQ(runner.locked([](const auto& s) { return s.objects().size(); }), 10000u);
}

}  // namespace
}  // namespace spring_workbench::live::pace_test
