#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/validation/input_error.h"
#include "support/bench_scenes.h"

namespace spring_workbench::live {
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

/// The box in the left hand, shaken; `until_second` [s]: samples of the right hand up to there.
struct Bench {
  SimulationRunner runner{two_boxes(), simulation::SimulationSettings(), hand_input::InputSettings(), false};
  double largest_error = 0.0;

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
    if (k == 1) events[0].push_back(StylusButton{t, motion::Press::grasp});
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
    EXPECT_EQ(bench.runner.show(0.0, {interval * k, interval * k}), 0.0);
    EXPECT_EQ(bench.runner.locked([](const auto& s) { return s.state_hash(); }), before);
    EXPECT_EQ(bench.runner.shown().time(), interval * k);
    EXPECT_LT((bench.runner.shown().fork().X_WH.translation() - hand_at(interval * k)).norm(), 1e-12);
    if (k > 0) {
      EXPECT_EQ(bench.runner.locked([](const auto& s) { return s.time(); }), interval * (k - 1));
    }
  }
  EXPECT_TRUE(bench.runner.shown().objects()[0].held);
}

TEST(LookAhead, ASilentSecondHandDelaysNoPictureOfTheFirst) {
  Bench bench;
  for (int k = 0; k < 60; ++k) {
    bench.commit(bench.sample(k, k < 30), interval * k);
    bench.runner.show(0.0, {interval * k, interval * k});
    EXPECT_EQ(bench.runner.shown().time(), interval * k);
    EXPECT_LT((bench.runner.shown().fork().X_WH.translation() - hand_at(interval * k)).norm(), 1e-12) << k;
  }
}

/// Hands whose epochs differ have stamps that differ by rounding: time goes on all the same.
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

/// What was shown for the newest sample is off by what its velocity was off by; further ahead by much more; and by
/// nothing where the hand goes straight on.
TEST(LookAhead, ErrorsAreThoseOfWhatWasShown) {
  double largest[2];
  for (const int further : {0, 1}) {
    Bench bench;
    std::vector<double> errors;
    for (int k = 0; k < 200; ++k) {
      bench.commit(bench.sample(k, false), interval * k);
      bench.runner.show(further * 0.03, {interval * k, interval * k});
    }
    largest[further] = bench.largest_error;
    EXPECT_LE(bench.runner.prediction_error_99(), bench.largest_error);
    EXPECT_GT(bench.runner.prediction_error_99(), 0.1 * bench.largest_error);
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
      bench.runner.show(0.02, {now + wait, now + wait});
      EXPECT_GE(bench.runner.shown().time(), before);
      before = bench.runner.shown().time();
    }
  }
}

/// A run with changes at random; the replayed journal comes to the same bits at every stop.
TEST(Journal, ReplayedComesToTheSameBits) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    Bench bench;
    std::mt19937 random(seed);
    std::vector<Entry> journal;
    std::vector<std::pair<double, std::uint64_t>> live;
    for (int k = 0; k < 300; ++k) {
      const double now = interval * k;
      if (k == 20) bench.runner.keep_journal(true);
      bench.commit(bench.sample(k, k < 100 || k > 180), now);
      if (random() % 30 == 0) {
        bench.runner.change("softer", [&](simulation::Simulation& s) {
          simulation::ForkChange change;
          change.stretch_stiffness = 100.0 + static_cast<double>(random() % 1000);
          return s.change(change, 0);
        });
      }
      if (random() % 90 == 0) bench.runner.change("release", [](simulation::Simulation& s) { return s.release(); });
      if (k % 10 == 0) bench.runner.note_state();
      for (Entry& entry : bench.runner.take_journal()) journal.push_back(entry);
    }
    bench.runner.note_state();
    for (Entry& entry : bench.runner.take_journal()) journal.push_back(entry);
    ASSERT_GT(journal.size(), 300u);
    Replayer replayer(
        [](const std::string&) { return simulation::Simulation(two_boxes(), simulation::SimulationSettings()); });
    int stops = 0;
    for (const Entry& entry : journal) replayer.play(entry, [&](auto&, auto&) { ++stops; });
    EXPECT_GT(stops, 200);
    EXPECT_GT(replayer.changes(), 3u);
    EXPECT_EQ(replayer.simulation()->state_hash(), bench.runner.locked([](const auto& s) { return s.state_hash(); }));
  }
}

TEST(Journal, AMissingEntryAndAnotherStateAreRefused) {
  Bench bench;
  bench.runner.keep_journal(true);
  for (int k = 0; k < 50; ++k) bench.commit(bench.sample(k, false), interval * k);
  bench.runner.note_state();
  std::vector<Entry> journal = bench.runner.take_journal();
  const auto play = [](const std::vector<Entry>& entries) {
    Replayer replayer(
        [](const std::string&) { return simulation::Simulation(two_boxes(), simulation::SimulationSettings()); });
    for (const Entry& entry : entries) replayer.play(entry, [](auto&, auto&) {});
  };
  EXPECT_NO_THROW(play(journal));
  std::vector<Entry> short_of_one = journal;
  short_of_one.erase(short_of_one.begin() + 20);
  EXPECT_THROW(play(short_of_one), validation::InputError);
  for (Entry& entry : journal) {
    auto* accepted = std::get_if<hand_input::Accepted>(&entry.what);
    if (accepted != nullptr && entry.index == 20) accepted->X_WH.translation().x() += 1e-12;
  }
  EXPECT_THROW(play(journal), validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::live
