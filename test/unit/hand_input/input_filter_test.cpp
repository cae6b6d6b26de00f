#include "spring_workbench/hand_input/input_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion/pose_predictor.h"
#include "spring_workbench/validation/input_error.h"
#include "support/bench_scenes.h"

namespace spring_workbench::hand_input::input_filter_test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kInterval = 0.01;
constexpr double kGravity = 9.81;

const Vector3d left(-0.5, 0.0, 0.7), right(0.5, 0.0, 0.7);  // handles: the tips are in the boxes

/// A box at the tip of each hand.
simulation::Simulation make_simulation(double step = 0.02) {
  const Vector3d size(0.1, 0.06, 0.04), tip(0.0, 0.0, -0.2);
  simulation::SimulationSettings settings;
  settings.dynamics.step = step;
  settings.grasp.release = tools::Release::dropped;
  return simulation::Simulation(
      scene_of({box("left", size, 1.0, left + tip), box("right", size, 1.0, right + tip)}, scene::ContactMode::none),
      settings);
}

/// A hand that shakes the box, is lost for a second and comes back elsewhere.
std::vector<motion::PoseSample> shaking_hand() {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1e-3);
  std::vector<motion::PoseSample> samples;
  for (int k = 0; k < 400; ++k) {
    const double t = kInterval * k + (k < 200 ? 0.0 : 1.0);
    RigidTransform X = pointing_down(left + Vector3d(0.2 * std::sin(4.0 * t) + noise(random), k < 200 ? 0.0 : 0.1,
                                                     0.1 * std::sin(7.0 * t) + noise(random)));
    X.linear() = X.linear() * math::exp_so3(Vector3d(0.3 * std::sin(3.0 * t), 0.0, 0.5 * std::sin(2.0 * t)));
    samples.push_back({t, X});
  }
  return samples;
}

void expect_same_objects(const simulation::Simulation& a, const simulation::Simulation& b) {
  for (std::size_t i = 0; i < a.objects().size(); ++i) {
    EXPECT_EQ(a.objects()[i].X_WO.matrix(), b.objects()[i].X_WO.matrix());
    EXPECT_EQ(a.objects()[i].V_WO_W.linear, b.objects()[i].V_WO_W.linear);
    EXPECT_EQ(a.objects()[i].V_WO_W.angular, b.objects()[i].V_WO_W.angular);
  }
}

/// Samples pushed all at once or one by one with advances in between give identical bits, as long as each advance ends
/// before the last sample but one, since the motion after it depends on later samples.
TEST(InputFilter, AMotionAtOnceAndSampleBySampleAreTheSame) {
  for (const double min_cutoff : {0.0, 2.0}) {
    InputSettings settings;
    settings.min_cutoff = min_cutoff;
    const std::vector<motion::PoseSample> samples = shaking_hand();
    simulation::Simulation at_once = make_simulation(), live = make_simulation();
    InputFilter feed_at_once(at_once, settings), feed_live(live, settings);
    for (const motion::PoseSample& sample : samples) feed_at_once.push_stylus(sample);
    feed_at_once.push_button(0.0, true);
    feed_live.push_button(0.0, true);
    simulation::AdvanceReport report;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      feed_live.push_stylus(samples[k]);
      if (k < 2) continue;
      report.add(feed_live.advance_to(samples[k - 2].t));
      if (k % 50 != 0) continue;
      feed_at_once.advance_to(samples[k - 2].t);
      expect_same_objects(at_once, live);
    }
    const double end = samples.back().t;
    report.add(feed_live.advance_to(end));
    feed_at_once.advance_to(end);
    expect_same_objects(at_once, live);
    EXPECT_NEAR(report.simulated_time, end, 1e-9);
    EXPECT_TRUE(live.objects()[0].held);
    EXPECT_EQ(feed_live.reacquisition_counts(0).reacquisitions, 1u);
    EXPECT_EQ(feed_at_once.reacquisition_counts(0).reacquisitions, 1u);
    EXPECT_EQ(feed_live.reacquisition_counts(0).late, 0u);
  }
}

/// A filter that predicts gives a copy the samples of a predictor that has seen the same poses; one that does not gives
/// none, and its simulation is the same.
TEST(InputFilter, OnlyOneThatPredictsGivesACopySamples) {
  simulation::Simulation simulations[] = {make_simulation(), make_simulation()};
  InputFilter without(simulations[0], InputSettings()),
      with(simulations[1], InputSettings(), InputFilter::Prediction::on);
  motion::PosePredictor predictor;
  with.record([&](const AcceptedInput& accepted) {
    if (accepted.kind == AcceptedInput::Kind::pose) predictor.push({accepted.t, accepted.X_WS});
  });
  for (const motion::PoseSample& sample : shaking_hand()) {
    if (sample.t > 1.99) break;  // before it is lost
    for (InputFilter* filter : {&without, &with}) {
      filter->push_stylus(sample);
      filter->advance_to(sample.t - 2.0 * kInterval);
    }
    simulation::Simulation copies[] = {make_simulation(), make_simulation(), make_simulation()};
    for (simulation::Simulation& copy : copies) copy.copy_state_from(simulations[1]);
    with.predict(sample.t + 0.03, copies[0]);
    for (const motion::PoseSample& next : predictor.continuation(sample.t + 0.03)) copies[1].push_stylus(next);
    EXPECT_EQ(copies[0].state_hash(), copies[1].state_hash());
    without.predict(sample.t + 0.03, copies[2]);
    EXPECT_EQ(copies[2].state_hash(), simulations[0].state_hash());
    EXPECT_EQ(copies[2].state_hash() == copies[0].state_hash(), sample.t == 0.0);
  }
}

TEST(InputFilter, APoseOfAMotionReachesTheSimulationToTheBit) {
  simulation::Simulation fed = make_simulation(), pushed = make_simulation();
  InputFilter filter(fed, InputSettings());
  for (const motion::PoseSample& sample : shaking_hand()) {
    if (sample.t > 1.99) break;  // before it is lost
    EXPECT_TRUE(usable(filter.push_stylus(sample)));
    pushed.push_stylus(sample);
  }
  filter.push_button(0.0, true);
  pushed.push_button(0.0, true);
  filter.advance_to(1.9);
  pushed.advance_to(1.9);
  EXPECT_TRUE(fed.objects()[0].held);
  expect_same_objects(fed, pushed);
}

/// Raw samples in the frame of a rotated tracker are equivalent to the poses in world.
TEST(InputFilter, RawSamplesInATrackersFrameAreThePosesInWorld) {
  const RigidTransform X_WP = make_transform(Vector3d(0.3, -0.2, 0.1), Quaterniond(0.8, 0.0, 0.6, 0.0));
  simulation::Simulation a = make_simulation(), b = make_simulation();
  InputFilter poses(a, InputSettings()), raw(b, InputSettings());
  for (const motion::PoseSample& sample : shaking_hand()) {
    const RigidTransform X_PH = X_WP.inverse() * sample.X;
    EXPECT_EQ(raw.push_stylus({sample.t, X_PH.translation(), Quaterniond(X_PH.linear())}, X_WP, {}),
              poses.push_stylus(sample));
  }
  poses.advance_to(3.0);
  raw.advance_to(3.0);
  EXPECT_LT((a.tool().X_WE.matrix() - b.tool().X_WE.matrix()).norm(), 1e-9);
}

TEST(InputFilter, LostHandsReleaseEachAtItsTime) {
  for (const OnLoss on_loss : {OnLoss::freeze, OnLoss::release}) {
    InputSettings settings;
    settings.on_loss = on_loss;
    settings.loss_timeout = 0.5;
    simulation::Simulation simulation = make_simulation();
    InputFilter filter(simulation, settings);
    const double ends[] = {1.5, 1.0};  // the second hand is lost first
    for (const std::size_t hand : {0u, 1u}) {
      filter.push_button(0.0, true, hand);
      for (double t = 0.0; t < ends[hand] + 0.5 * kInterval; t += kInterval)
        filter.push_stylus({std::min(t, ends[hand]), pointing_down(hand == 0 ? left : right)}, hand);
    }
    filter.advance_to(1.4);
    const std::vector<bodies::BodyState> held = simulation.objects();
    ASSERT_TRUE(held[0].held && held[1].held);
    const double end = 5.0;
    const simulation::AdvanceReport report = filter.advance_to(end);
    EXPECT_NEAR(report.simulated_time, end - 1.4, 1e-9);
    for (const std::size_t hand : {0u, 1u}) {
      const bodies::BodyState& object = simulation.objects()[hand];
      EXPECT_EQ(object.held, on_loss == OnLoss::freeze);
      EXPECT_EQ(filter.reacquisition_counts(hand).losses, 1u);
      const double fall = on_loss == OnLoss::freeze ? 0.0 : end - (ends[hand] + settings.loss_timeout);
      EXPECT_NEAR(held[hand].X_WO.translation().z() - object.X_WO.translation().z(), 0.5 * kGravity * fall * fall,
                  1e-4);
    }
  }
}

/// Commits up to all stops until `now`.
void commit(InputFilter& filter, const LocalTime& now) {
  while (const auto stop = filter.next_target(now)) filter.advance_to(*stop);
}

TEST(InputFilter, TheSlowestHandLimitsTimeUntilItIsSilent) {
  simulation::Simulation simulation = make_simulation();
  InputFilter filter(simulation, InputSettings());
  const RigidTransform X_WP = RigidTransform::Identity();
  const RawSample at_left{0.0, left, Quaterniond(pointing_down(left).linear())};
  EXPECT_FALSE(filter.has_sample());
  EXPECT_FALSE(filter.next_target({1.0, 1.0}));
  for (int k = 0; k < 100; ++k) {
    RawSample sample = at_left;
    sample.t = kInterval * k;
    filter.push_stylus(sample, X_WP, {sample.t, sample.t}, 0);
    if (k <= 50) filter.push_stylus(sample, X_WP, {sample.t, sample.t}, 1);
  }
  commit(filter, {0.99, 0.99});
  EXPECT_EQ(simulation.time(), kInterval * 49);
  commit(filter, {1.01, 1.01});  // the second is silent now: only the first counts
  EXPECT_EQ(simulation.time(), kInterval * 98);
  commit(filter, {2.0, 2.0});  // both are
  const double steps = (simulation.time() - kInterval * 99) / simulation.settings().dynamics.step;
  EXPECT_NEAR(steps, std::round(steps), 1e-6);
  EXPECT_NEAR(simulation.time(), 1.98, simulation.settings().dynamics.step);
  filter.restart();
  EXPECT_FALSE(filter.has_sample());
  EXPECT_FALSE(filter.next_target({3.0, 3.0}));
  EXPECT_EQ(filter.gate_counts(0).accepted, 100u);
  EXPECT_FALSE(usable(filter.push_stylus(at_left, X_WP, {}, 0)));  // the gate goes on
  filter.restart_gate(0);
  EXPECT_TRUE(usable(filter.push_stylus(at_left, X_WP, {}, 0)));
}

/// Identical bits whether commits are frequent or rare, or paused after any number of steps, with buttons at any time,
/// through a loss and a silence.
TEST(InputFilter, WhatIsCommittedDependsOnTheMessagesAlone) {
  std::vector<simulation::SimulationState> ends;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int interrupted = 0;
  for (const auto& [every, pauses] : {std::pair(1u, false), {3u, false}, {17u, false}, {1u, true}, {17u, true}}) {
    simulation::Simulation simulation = make_simulation(0.0031);
    InputSettings settings;
    settings.on_loss = OnLoss::release;
    settings.loss_timeout = 0.52;
    InputFilter filter(simulation, settings);
    const auto commit = [&, pauses = pauses](double t) {
      while (const auto stop = filter.next_target({10.0 + t, 10.0 + t})) {
        const double begin = simulation.time();
        filter.advance_to(*stop, pauses ? begin + share(random) * (*stop - begin) : kInf);
        interrupted += filter.is_interrupted() ? 1 : 0;
        EXPECT_LE(filter.target(), *stop);  // earlier if the hand is lost on the way
        EXPECT_EQ(filter.target() > simulation.time(), filter.is_interrupted());
      }
    };
    unsigned count = 0;
    for (const motion::PoseSample& sample : shaking_hand()) {
      const LocalTime now{10.0 + sample.t, 10.0 + sample.t};
      const Quaterniond q(sample.X.linear());
      if (count % 7 == 0) filter.push_button(sample.t + 0.3 * kInterval, count % 70 != 63);
      if (count % 7 == 0) filter.confirm_buttons(sample.t + 0.3 * kInterval, now);
      filter.push_stylus({sample.t, sample.X.translation(), q}, RigidTransform::Identity(), now);
      if (++count % every == 0 || count == 200) commit(sample.t);
    }
    for (double t = 5.0; t < 6.0; t += pauses ? 0.1 * share(random) : 0.05) commit(t);
    commit(6.0);
    EXPECT_GT(simulation.time(), 5.9);
    EXPECT_EQ(filter.reacquisition_counts(0).losses, 2u);
    ends.push_back(simulation.save());
  }
  EXPECT_GT(interrupted, 500);
  for (const simulation::SimulationState& end : ends) EXPECT_EQ(end.hash(), ends[0].hash());
}

/// Invalid samples of every kind, mixed with those of a hand.
std::vector<RawSample> rubbish(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-2.0, 2.0);
  const double odd[] = {std::nan(""), kInf, -kInf, 0.0, 1e300, -1e300, 1e-300};
  const auto any = [&] { return random() % 4 == 0 ? odd[random() % 7] : number(random); };
  std::vector<RawSample> samples;
  for (int k = 0; k < count; ++k) {
    RawSample sample{kInterval * k, left + 0.1 * Vector3d(std::sin(0.05 * k), 0.0, std::cos(0.03 * k)),
                     Quaterniond(pointing_down(left).linear())};
    switch (random() % 12) {
      case 0:
        sample.p = Vector3d(any(), any(), any());
        break;
      case 1:
        sample.q = Quaterniond(any(), any(), any(), any());
        break;
      case 2:
        sample.t = random() % 2 == 0 ? odd[random() % 3] : sample.t + kInterval * number(random);
        break;
      case 3:
        sample = {sample.t, Vector3d::Zero(), Quaterniond::Identity()};
        break;
      default:
        break;
    }
    samples.push_back(sample);
  }
  return samples;
}

TEST(InputFilter, NothingThatIsNotFiniteReachesTheSimulationAndTheGateCountsAsAlone) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    simulation::Simulation simulation = make_simulation();
    const InputSettings settings;
    InputFilter filter(simulation, settings);
    SampleGate gate(settings, simulation.settings().dropout_after);
    filter.push_button(0.0, true);
    double t = 0.0;
    for (const RawSample& sample : rubbish(seed, 500)) {
      EXPECT_EQ(filter.push_stylus(sample, RigidTransform::Identity(), {t, t}), gate.offer(sample));
      filter.advance_to(t);
      t += kInterval;
      for (const bodies::BodyState& object : simulation.objects()) {
        ASSERT_TRUE(object.X_WO.matrix().allFinite());
        ASSERT_TRUE(object.V_WO_W.linear.allFinite() && object.V_WO_W.angular.allFinite());
      }
      ASSERT_TRUE(simulation.tool().X_WE.matrix().allFinite());
    }
    const GateCounts &in_feed = filter.gate_counts(0), &alone = gate.counts();
    EXPECT_EQ(in_feed.accepted, alone.accepted);
    EXPECT_EQ(in_feed.relocations, alone.relocations);
    EXPECT_EQ(in_feed.dropouts, alone.dropouts);
    EXPECT_EQ(in_feed.sign_flips, alone.sign_flips);
    EXPECT_EQ(in_feed.rejected, alone.rejected);
    EXPECT_GT(alone.accepted, 100u);
    EXPECT_GE(alone.rejected.size(), 4u);
  }
}

TEST(InputFilter, AHandThatDoesNotExistIsRefusedByName) {
  simulation::Simulation simulation = make_simulation();
  InputFilter filter(simulation, {});
  const RigidTransform here = RigidTransform::Identity();
  const std::vector<std::function<void()>> calls = {
      [&] {
        filter.push_stylus(motion::PoseSample{0.0, here}, 2);
      },
      [&] {
        filter.push_stylus(RawSample{}, here, {0.0, 0.0}, 2);
      },
      [&] { filter.push_edge(0.0, motion::ButtonEdge::grasp, 2); },
      [&] { filter.push_external_wrench({}, 2); },
      [&] {
        filter.confirm_buttons(0.0, {0.0, 0.0}, 2);
      },
      [&] {
        filter.report_arrival({0.0, 0.0}, 2);
      },
      [&] { filter.restart_gate(2); },
      [&] { filter.gate_counts(2); },
      [&] { filter.reacquisition_counts(2); },
      [&] { filter.tracker_moves(2); },
  };
  for (const auto& call : calls) {
    try {
      call();
      FAIL();
    } catch (const validation::InputError& e) {
      EXPECT_STREQ(e.what(), "hand: invalid value '2': expected an integer between 0 and 1");
    }
  }
}

}  // namespace
}  // namespace spring_workbench::hand_input::input_filter_test
