#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/validation/input_error.h"
#include "support/bench_scenes.h"
#include "support/snapshots.h"

namespace spring_workbench::live::live_test {
namespace {

constexpr double interval = 0.01;

const Vector3d left(-0.5, 0.0, 0.7), right(0.5, 0.0, 0.7);  // handles: the tips are in the boxes

scene::Scene two_boxes() {
  const Vector3d size(0.1, 0.06, 0.04), tip(0.0, 0.0, -0.2);
  return scene_of({box("left", size, 1.0, left + tip), box("right", size, 1.0, right + tip)}, scene::ContactMode::none);
}

Vector3d hand_at(double t) {
  return left + Vector3d(0.2 * std::sin(4.0 * t), 0.05 * std::sin(t), 0.1 * std::sin(7.0 * t));
}

StylusPose pose_at(double t, const Vector3d& p) {
  StylusPose pose;
  pose.sample = {t, p, Quaterniond(pointing_down(p).linear())};
  pose.arrival = {t, t};
  return pose;
}

/// The box in the left hand, shaken, on a processor that takes no time.
struct Bench {
  explicit Bench(int styluses = 2)
      : runner(two_boxes(), of(styluses), hand_input::InputSettings(), false, Pace([] { return 0.0; })) {}
  static simulation::SimulationSettings of(int styluses) {
    simulation::SimulationSettings settings;
    settings.styluses = styluses;
    return settings;
  }
  SimulationRunner runner;
  double largest_error = 0.0;
  Shown last;

  double show(double latency, double now) {
    last = *runner.show(latency, {now, now}, always);
    return last.horizon;
  }
  const View& shown() const { return last.view; }
  void commit(const HandEvents& events, double now) {
    CycleReport report = runner.cycle(events, {now, now});
    for (; report.more; report = runner.cycle({}, {now, now})) note(report);
    note(report);
  }
  void note(const CycleReport& report) { largest_error = std::max(largest_error, report.prediction.position); }
  HandEvents sample(int k, bool second) {
    HandEvents events;
    const double t = interval * k;
    if (k == 0) events[0].push_back(NewEpoch{});
    if (k == 0 && second) events[1].push_back(NewEpoch{});
    if (k == 1) events[0].push_back(StylusButton{t, motion::ButtonEdge::grasp});
    events[0].push_back(pose_at(t, hand_at(t)));
    if (second) events[1].push_back(pose_at(t, right));
    return events;
  }
};

TEST(LookAhead, ShowsTheNewestSampleAtOnceAndLeavesTheCommittedAlone) {
  Bench bench;
  for (int k = 0; k < 100; ++k) {
    bench.commit(bench.sample(k, false), interval * k);
    const std::uint64_t before = bench.runner.locked([](const auto& s) { return s.state_hash(); });
    EXPECT_EQ(bench.show(0.0, interval * k), 0.0);
    EXPECT_EQ(bench.runner.locked([](const auto& s) { return s.state_hash(); }), before);
    EXPECT_EQ(bench.shown().time, interval * k);
    EXPECT_LT((bench.shown().tools.front().X_WH.translation() - hand_at(interval * k)).norm(), 1e-12);
    if (k > 0) {
      EXPECT_EQ(bench.runner.locked([](const auto& s) { return s.time(); }), interval * (k - 1));
    }
  }
  EXPECT_TRUE(bench.shown().objects[0].held);
}

/// The copy is not advanced again while nothing has changed, so what is shown must not depend on when it was last asked
/// for: after each event and change, or only now.
TEST(LookAhead, WhatIsShownDoesNotDependOnHowOftenItIsAskedFor) {
  Bench often, once;
  std::mt19937 random(7);
  const auto one_of = [&](unsigned n) { return random() % n; };
  std::size_t compared = 0, held = 0;
  for (int k = 0; k < 400; ++k) {
    const double t = interval * k;
    HandEvents events;
    if (k == 0) events[0].push_back(NewEpoch{});
    events[0].push_back(pose_at(t, left + 0.01 * Vector3d(std::sin(9.0 * t), std::sin(5.0 * t), std::sin(7.0 * t))));
    if (one_of(3) == 0) events[0].push_back(ButtonsKnown{t, {t, t}});
    if (one_of(8) == 0)
      events[0].push_back(StylusButton{t - 0.3 * interval, static_cast<motion::ButtonEdge>(one_of(3))});
    if (one_of(5) == 0) {
      StylusWrench wrench;
      wrench.stamp = std::llround(1e9 * (t - 0.6 * interval));
      wrench.sample.wrench.force = Vector3d(1.0 + static_cast<double>(one_of(9)), 0.0, 0.0);
      events[0].push_back(wrench);
    }
    Command command;
    command.kind = std::array{Command::Kind::release, Command::Kind::calibrate, Command::Kind::clutch}[one_of(3)];
    const bool changes = one_of(20) == 0, restarts = one_of(25) == 0;
    std::array<std::optional<Shown>, 2> shown;
    for (Bench* bench : {&often, &once}) {
      std::optional<Shown>& last = shown[bench == &often ? 0 : 1];
      for (std::size_t i = 0; i < events[0].size(); ++i) {
        bench->commit({{0, {events[0][i]}}}, t);
        if (bench == &often) bench->runner.show(0.0, {t, t}, always);
      }
      last = bench->runner.show(0.0, {t, t}, always);
      if (restarts) bench->runner.restart();
      try {
        if (changes) bench->runner.change("test", command);
      } catch (const validation::InputError&) {  // nothing is held
      }
    }
    ASSERT_EQ(shown[0].has_value(), shown[1].has_value()) << k;
    if (!shown[0]) continue;
    ++compared;
    ASSERT_EQ(shown[0]->view.time, shown[1]->view.time) << k;
    const View &a = shown[0]->view, &b = shown[1]->view;
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_EQ(a.objects[i].X_WO.matrix(), b.objects[i].X_WO.matrix()) << k;
      ASSERT_EQ(a.objects[i].held, b.objects[i].held) << k;
      held += a.objects[i].held ? 1 : 0;
    }
    ASSERT_EQ(a.tools[0].tip_wrench_W.force, b.tools[0].tip_wrench_W.force) << k;
  }
  EXPECT_GT(compared, 200u);
  EXPECT_GT(held, 50u);
}

TEST(LookAhead, ASilentSecondHandDelaysNoPictureOfTheFirst) {
  Bench bench;
  for (int k = 0; k < 60; ++k) {
    bench.commit(bench.sample(k, k < 30), interval * k);
    bench.show(0.0, interval * k);
    EXPECT_EQ(bench.shown().time, interval * k);
    EXPECT_LT((bench.shown().tools.front().X_WH.translation() - hand_at(interval * k)).norm(), 1e-12) << k;
  }
}

/// What is committed waits for a hand that falls silent until it counts as silent, once, and then goes on as without
/// it, through every sample of the other hand. A silent hand that comes back is waited for until its second sample.
TEST(Commitment, ASilentHandIsWaitedForOnceAndThenDelaysNobody) {
  Bench bench;
  constexpr int last = 29, back = 200;  // the second hand is silent between these samples
  const int silent = last + static_cast<int>(std::lround(simulation::SimulationSettings().dropout_after / interval));
  std::set<double> stops;
  for (int k = 0; k < 300; ++k) {
    const double t = interval * k;
    HandEvents events = bench.sample(k, k <= last || k >= back);
    for (bool more = true; more; events = {}) {
      more = bench.runner.cycle(events, {t + 0.1 * interval, t + 0.1 * interval}).more;
      stops.insert(bench.runner.locked([](const auto& s) { return s.time(); }));
    }
    const bool waits = k > last && k < silent;
    const int newest = waits ? last - 1 : k == back ? k - 2 : k - 1;
    if (k > 0) {
      EXPECT_EQ(*stops.rbegin(), interval * newest) << k;
    }
  }
  for (int k = 1; k < 299; ++k) EXPECT_EQ(stops.count(interval * k), 1u) << k;
}

/// Stations of one tracker measure in turn, one per cycle. Each pose of the first hand is displayed in its own cycle,
/// whatever the other stations do, and committed once the next pose of each hand has arrived: with one hand after as
/// many cycles as there are stations, with a second hand, whose turn is next, after one more.
TEST(LookAhead, StationsInTurnDelayTheDisplayByNothingAndTheCommittedByOneTurn) {
  for (const auto& [stations, hands] : {std::pair(1, 1), {2, 1}, {2, 2}, {4, 1}, {4, 2}}) {
    Bench bench;
    int slowest = 0;
    std::vector<int> uncommitted;  // cycles whose poses are
    for (int cycle = 0; cycle < 200; ++cycle) {
      const double t = cycle / 120.0;
      const std::size_t station = static_cast<std::size_t>(cycle % stations);
      HandEvents events;
      if (station < static_cast<std::size_t>(hands)) {
        if (cycle < stations) events[station].push_back(NewEpoch{});
        if (cycle == stations) events[0].push_back(StylusButton{t, motion::ButtonEdge::grasp});
        events[station].push_back(pose_at(t, station == 0 ? hand_at(t) : right));
      }
      bench.commit(events, t);
      bench.show(0.0, t);
      if (station == 0) {
        EXPECT_EQ(bench.shown().time, t) << stations << " stations, cycle " << cycle;
        EXPECT_LT((bench.shown().tools.front().X_WH.translation() - hand_at(t)).norm(), 1e-12) << cycle;
        uncommitted.push_back(cycle);
      }
      const double committed = bench.runner.locked([](const auto& s) { return s.time(); });
      while (!uncommitted.empty() && uncommitted.front() / 120.0 <= committed) {
        slowest = std::max(slowest, cycle - uncommitted.front());
        uncommitted.erase(uncommitted.begin());
      }
    }
    EXPECT_EQ(slowest, stations + hands - 1) << stations << " stations";
    EXPECT_LE(uncommitted.size(), 2u);
  }
}

/// Hands with different epochs have stamps that differ by rounding; time advances nevertheless.
TEST(LookAhead, TwoHandsThatDifferByARoundingErrorGoOnTogether) {
  Bench bench;
  for (int k = 0; k < 60; ++k) {
    HandEvents events = bench.sample(k, false);
    if (k == 10) events[1].push_back(NewEpoch{100'000'000});
    if (k >= 10) events[1].push_back(pose_at(interval * k - 0.1, right));
    if (k >= 10) std::get<StylusPose>(events[1].back()).arrival = {interval * k, interval * k};
    CycleReport report = bench.runner.cycle(events, {interval * k, interval * k});
    for (int calls = 0; report.more && calls < 10; ++calls) {
      report = bench.runner.cycle({}, {interval * k, interval * k});
    }
    ASSERT_FALSE(report.more) << k;
  }
  EXPECT_NEAR(bench.runner.locked([](const auto& s) { return s.time(); }), interval * 58, 1e-9);
}

/// The display at the newest sample has the error of its velocity; further ahead the error is much larger. The errors
/// at the start are the largest: two samples determine a line only.
TEST(LookAhead, ErrorsAreThoseOfTheDisplayedPoses) {
  double largest[2];
  for (const int further : {0, 1}) {
    Bench bench;
    std::vector<double> errors;
    for (int k = 0; k < 200; ++k) {
      bench.commit(bench.sample(k, false), interval * k);
      bench.show(further * 0.03, interval * k);
      if (k == 10) largest[further] = std::exchange(bench.largest_error, 0.0);
    }
    EXPECT_LE(bench.runner.prediction_error_99(), largest[further]);
    EXPECT_GT(bench.runner.prediction_error_99(), 0.9 * bench.largest_error);
  }
  EXPECT_GT(largest[0], 1e-9);
  EXPECT_LT(largest[0], 1e-4);
  EXPECT_GT(largest[1], 10.0 * largest[0]);
  EXPECT_LT(largest[1], 1e-2);
}

TEST(LookAhead, WhatIsShownDoesNotGoBack) {
  Bench bench;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> late(0.0, 0.03);
  double before = -1.0, now = 0.0;
  for (int k = 0; k < 300; ++k) {
    now = std::max(now, interval * k + late(random));
    HandEvents events = bench.sample(k, false);
    std::get<StylusPose>(events[0].back()).arrival = {now, now};
    bench.commit(events, now);
    for (const double wait : {0.0, 0.004}) {
      bench.show(0.02, now + wait);
      EXPECT_GE(bench.shown().time, before);
      before = bench.shown().time;
    }
  }
}

/// An object is removed while there is no time to look ahead: the copy still contains it and does not match the scene.
TEST(LookAhead, WhatHasNotFollowedAnEditIsNotShown) {
  simulation::Simulation committed(two_boxes(), {});
  hand_input::InputFilter filter(committed, hand_input::InputSettings());
  LookAhead ahead(two_boxes(), {});
  for (int k = 0; k < 10; ++k) filter.push_stylus({interval * k, pointing_down(left)});
  const Pace quick;
  Pace slow;
  slow.committed(1e-3, 1.0, 0.0);
  ahead.show_newest(committed, filter, 0.05, quick);
  EXPECT_TRUE(ahead.has_followed());
  committed.edit({simulation::ObjectEdit::Action::remove, "right", "", std::nullopt});
  ahead.restart();
  ahead.show_newest(committed, filter, 0.05, slow);
  EXPECT_FALSE(ahead.has_followed());
  ahead.show_newest(committed, filter, 0.05, quick);
  EXPECT_TRUE(ahead.has_followed());
  EXPECT_EQ(ahead.shown().objects().size(), 1u);
}

Replayer replayer_of_two_boxes() {
  return {[](const std::string&) { return two_boxes(); }, {}};
}

/// A random change as by a service, a panel or a time jump.
Command random_command(std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  using Kind = Command::Kind;
  constexpr Kind kinds[] = {Kind::select_tool, Kind::settings, Kind::settings, Kind::settings,
                            Kind::calibrate,   Kind::release,  Kind::clutch};
  constexpr tools::Tool every_tool[] = {tools::Tool::spring, tools::Tool::spring_fork, tools::Tool::spring_probe,
                                        tools::Tool::direct, tools::Tool::ray};
  Command command;
  command.kind = kinds[random() % 7];
  if (random() % 12 == 0) command.kind = random() % 2 == 0 ? Kind::restart : Kind::load_scene;
  if (random() % 3 > 0) command.hand = random() % 2;
  command.tool = every_tool[random() % 5];
  command.on = random() % 2 == 0;
  if (random() % 2 == 0) command.fork_change.dofs = {random() % 2 == 0, random() % 2 == 0, random() % 2 == 0};
  if (random() % 2 == 0) command.fork_change.stiffness.stretch = uniform(100.0, 1000.0);
  if (random() % 2 == 0) command.fork_change.stiffness.torsion = uniform(0.1, 10.0);
  if (random() % 3 == 0) command.fork_change.damping_ratio = {0.2, 0.2, 0.2};
  if (random() % 4 == 0) command.dynamics_change.step = uniform(0.001, 0.004);
  if (random() % 4 == 0) command.dynamics_change.integrator = dynamics::IntegratorKind::rk4;
  return command;
}

void change_at_random(SimulationRunner& runner, std::mt19937& random) {
  const Command command = random_command(random);
  try {
    if (command.kind == Command::Kind::restart) {
      runner.restart();
    } else if (command.kind == Command::Kind::load_scene) {
      runner.load(two_boxes());
    } else {
      runner.change("at random", command);
    }
  } catch (const validation::InputError&) {  // nothing is held
  }
}

/// A measurement of a machine's force sensor at `t` on the object of the first hand.
StylusWrench wrench_at(double t) {
  const Wrench pull{{3.0 * std::sin(9.0 * t), 1.0, 5.0}, {0.0, 0.02, 0.01}};
  const auto axes = static_cast<motion::ExternalWrench::Axes>(std::llround(t / interval) % 2);
  return {std::llround(1e9 * t), {0.0, pull, axes}};
}

/// The journal of a run with random changes and a sensor whose messages are randomly late or missing; also returns the
/// hash of the final state.
std::vector<Entry> random_journal(unsigned seed, std::uint64_t& hash) {
  Bench bench(2 + static_cast<int>(seed % 3));
  std::mt19937 random(seed);
  std::vector<Entry> journal;
  for (int k = 0; k < 300; ++k) {
    if (k == 20) bench.runner.keep_journal(true);
    HandEvents events = bench.sample(k, k < 100 || k > 180);
    if (bench.runner.hands() > 2) {
      if (k == 60) events[2].push_back(NewEpoch{});
      if (k == 70) events[2].push_back(StylusButton{interval * k, motion::ButtonEdge::grasp});
      if (k >= 60) events[2].push_back(pose_at(interval * k, right));
    }
    if (k % 60 > 30) events[0].push_back(wrench_at(interval * (k - 0.01 * static_cast<double>(random() % 400))));
    bench.commit(events, interval * k);
    if (random() % 20 == 0) change_at_random(bench.runner, random);
    if (k % 10 == 0) bench.runner.note_state();
    for (Entry& entry : bench.runner.take_journal()) journal.push_back(entry);
  }
  bench.runner.note_state();
  for (Entry& entry : bench.runner.take_journal()) journal.push_back(entry);
  hash = bench.runner.locked([](const auto& s) { return s.state_hash(); });
  return journal;
}

/// Each change is repeated at its time from its encoded command and leads to identical bits, like everything else.
TEST(Journal, ReplayedComesToTheSameBits) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::uint64_t hash = 0;
    std::vector<Entry> journal = random_journal(seed, hash);
    ASSERT_GT(journal.size(), 300u);
    Replayer replayer = replayer_of_two_boxes();
    int stops = 0, timeouts = 0;
    for (Entry& entry : journal) {
      if (auto* change = std::get_if<Change>(&entry.what)) change->command = Command::from(change->command.words());
      replayer.play(entry, [&](auto&, const simulation::AdvanceReport& report) {
        ++stops;
        timeouts += report.wrench_timeouts;
      });
    }
    EXPECT_GT(stops, 200);
    EXPECT_GT(timeouts, 1);
    const auto is_wrench = [](const Entry& entry) {
      const auto* accepted = std::get_if<hand_input::AcceptedInput>(&entry.what);
      return accepted != nullptr && accepted->kind == hand_input::AcceptedInput::Kind::external_wrench;
    };
    EXPECT_GT(std::count_if(journal.begin(), journal.end(), is_wrench), 100);
    EXPECT_GT(replayer.changes().repeated, 5u);
    EXPECT_EQ(replayer.changes().restored, 0u);
    for (const std::string& mismatch : replayer.changes().mismatches) ADD_FAILURE() << seed << ": " << mismatch;
    EXPECT_EQ(replayer.simulation()->state_hash(), hash);
  }
}

/// It acts at its stamp if it arrives before that time is committed.
TEST(ExternalWrench, ActsAtItsStamp) {
  RigidTransform X_WO[3];
  for (const int late : {0, 1, 2}) {  // 2: there is none
    Bench bench;
    for (int k = 0; k < 60; ++k) {
      HandEvents events = bench.sample(k, false);
      const double t = interval * (k - late - 0.5);
      if (late < 2 && t > 0.29 && t < 0.5) events[0].push_back(wrench_at(t));
      bench.commit(events, interval * k);
    }
    X_WO[late] = bench.runner.locked([](const auto& s) { return s.objects()[0].X_WO; });
  }
  EXPECT_EQ(X_WO[0].matrix(), X_WO[1].matrix());
  EXPECT_NE(X_WO[0].matrix(), X_WO[2].matrix());
}

/// A change whose command has a different result is reported, and the run continues from the recorded state.
TEST(Journal, ARepeatedChangeWithAnotherResultIsCountedAndReported) {
  Bench bench;
  bench.runner.keep_journal(true);
  Command softer;
  softer.kind = Command::Kind::settings;
  softer.fork_change.stiffness.stretch = 300.0;
  for (int k = 0; k < 50; ++k) {
    bench.commit(bench.sample(k, false), interval * k);
    if (k == 30) bench.runner.change("softer", softer);
  }
  bench.runner.note_state();
  Replayer replayer = replayer_of_two_boxes();
  for (Entry& entry : bench.runner.take_journal()) {
    auto* change = std::get_if<Change>(&entry.what);
    if (change != nullptr && change->what == "softer") change->command.fork_change.stiffness.stretch = 300.1;
    replayer.play(entry, [](auto&, auto&) {});
  }
  ASSERT_EQ(replayer.changes().mismatches.size(), 1u);
  EXPECT_EQ(replayer.changes().mismatches[0].rfind("softer at 0.29", 0), 0u) << replayer.changes().mismatches[0];
  EXPECT_EQ(replayer.simulation()->state_hash(), bench.runner.locked([](const auto& s) { return s.state_hash(); }));
}

/// A recorder beside another listener is connected to the two topics one after the other, and the state is noted again
/// once it is connected to both. In either order, its recording is replayed to the same bits, but not if an entry is
/// missing later.
TEST(Journal, OfALateRecorderBeginsWithTheStateAfterBothConnections) {
  for (const bool changes_first : {true, false}) {
    Bench bench;
    std::vector<Entry> recorded;
    for (int k = 0; k < 80; ++k) {
      if (k == 10 || k == 60) bench.runner.keep_journal(true);
      bench.commit(bench.sample(k, false), interval * k);
      if (k % 10 == 5) bench.runner.note_state();
      if (k == 50) bench.runner.restart();
      for (Entry& entry : bench.runner.take_journal()) {
        const bool is_change = std::holds_alternative<Change>(entry.what);
        if (k >= (is_change == changes_first ? 30 : 58)) recorded.push_back(std::move(entry));
      }
    }
    bench.runner.note_state();
    for (Entry& entry : bench.runner.take_journal()) recorded.push_back(std::move(entry));
    const auto replayed = [](const std::vector<Entry>& entries) {
      Replayer replayer = replayer_of_two_boxes();
      for (const Entry& entry : entries) replayer.play(entry, [](auto&, auto&) {});
      return replayer.simulation()->state_hash();
    };
    std::stable_partition(recorded.begin(), recorded.end(),
                          [](const Entry& entry) { return std::holds_alternative<Change>(entry.what); });
    EXPECT_EQ(lives_of(recorded).size(), 1u);
    const std::vector<Entry> complete = from_first_complete(recorded);
    EXPECT_EQ(replayed(complete), bench.runner.locked([](const auto& s) { return s.state_hash(); }));
    std::vector<Entry> short_of_one = recorded;
    short_of_one.erase(std::find_if(short_of_one.begin(), short_of_one.end(), [&](const Entry& entry) {
      return entry.index == complete[complete.size() - 10].index;
    }));
    EXPECT_THROW(replayed(from_first_complete(short_of_one)), validation::InputError);
  }
}

/// A node that is killed and resumes from its checkpoint counts from 0 again. Each of its lives is a run of its own.
TEST(Journal, OfANodeThatWasKilledHasSeveralLives) {
  std::vector<Entry> recorded;
  std::vector<std::uint64_t> hashes;
  std::optional<simulation::SimulationState> state;
  for (const int length : {60, 30, 80}) {
    Bench bench;
    if (state) bench.runner.resume(two_boxes(), *state);
    bench.runner.keep_journal(true);
    for (int k = 0; k < length; ++k) {
      bench.commit(bench.sample(k, false), interval * k);
      if (k % 10 == 5) bench.runner.note_state();
    }
    bench.runner.note_state();
    for (Entry& entry : bench.runner.take_journal()) recorded.push_back(std::move(entry));
    state = bench.runner.locked([](const auto& s) { return s.save(); });
    hashes.push_back(state->hash());
  }
  const std::vector<std::vector<Entry>> lives = lives_of(recorded);
  ASSERT_EQ(lives.size(), 3u);
  for (std::size_t i = 0; i < lives.size(); ++i) {
    Replayer replayer = replayer_of_two_boxes();
    for (const Entry& entry : from_first_complete(lives[i])) replayer.play(entry, [](auto&, auto&) {});
    EXPECT_EQ(replayer.simulation()->state_hash(), hashes[i]) << i;
  }
}

TEST(Journal, WordsThatAreNoCommandAreRefused) {
  Command softer;
  softer.kind = Command::Kind::settings;
  softer.fork_change.stiffness.stretch = 300.0;
  std::vector<std::uint64_t> words = softer.words();
  EXPECT_EQ(Command::from(words).fork_change.stiffness.stretch, 300.0);
  words.push_back(0);
  EXPECT_THROW(Command::from(words), validation::InputError);
  words.resize(words.size() - 2);
  EXPECT_THROW(Command::from(words), validation::InputError);
}

TEST(Journal, AMissingEntryAndAnotherStateAreRefused) {
  Bench bench;
  bench.runner.keep_journal(true);
  for (int k = 0; k < 50; ++k) bench.commit(bench.sample(k, false), interval * k);
  bench.runner.note_state();
  std::vector<Entry> journal = bench.runner.take_journal();
  const auto play = [](const std::vector<Entry>& entries) {
    Replayer replayer = replayer_of_two_boxes();
    for (const Entry& entry : entries) replayer.play(entry, [](auto&, auto&) {});
  };
  EXPECT_NO_THROW(play(journal));
  std::vector<Entry> short_of_one = journal;
  short_of_one.erase(short_of_one.begin() + 20);
  EXPECT_THROW(play(short_of_one), validation::InputError);
  for (Entry& entry : journal) {
    auto* accepted = std::get_if<hand_input::AcceptedInput>(&entry.what);
    if (accepted != nullptr && entry.index == 20) accepted->X_WS.translation().x() += 1e-12;
  }
  EXPECT_THROW(play(journal), validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::live::live_test
