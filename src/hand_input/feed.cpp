#include "spring_workbench/hand_input/feed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "spring_workbench/hand_input/playout_clock.h"
#include "spring_workbench/hand_input/pose_filter.h"

namespace spring_workbench::hand_input {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

}  // namespace

struct Feed::Hand {
  SampleGate gate;
  PoseFilter smoothing;
  Reacquisition reacquisition;
  PlayoutClock playout;
  bool has_sample = false;  ///< since the start
};

Feed::Feed(simulation::Simulation& simulation, const InputSettings& settings, bool simulated_time)
    : simulation_(simulation) {
  const double dropout_after = simulation.settings().dropout_after;
  const Hand hand{SampleGate(settings, dropout_after), PoseFilter(settings), Reacquisition(settings),
                  PlayoutClock(dropout_after, simulated_time)};
  hands_.assign(simulation::Simulation::most_hands, hand);
}

Feed::~Feed() = default;

const GateCounts& Feed::gate_counts(std::size_t hand) const { return hands_.at(hand).gate.counts(); }
const ReacquisitionCounts& Feed::reacquisition_counts(std::size_t hand) const {
  return hands_.at(hand).reacquisition.counts();
}

GateResult Feed::push_stylus(const RawSample& sample, const RigidTransform& X_WP, const LocalTime& arrival,
                             std::size_t hand) {
  const GateResult result = hands_.at(hand).gate.offer(sample);
  if (usable(result)) follow({sample.t, make_transform(sample.q, sample.p)}, result, &X_WP, arrival, hand);
  return result;
}

GateResult Feed::push_stylus(const motion::PoseSample& sample, std::size_t hand) {
  const GateResult result =
      hands_.at(hand).gate.offer({sample.t, sample.X.translation(), Quaterniond(sample.X.linear())});
  if (usable(result)) follow(sample, result, nullptr, {}, hand);
  return result;
}

/// `X_WP`: none where the sample is in world.
void Feed::follow(const motion::PoseSample& sample, GateResult result, const RigidTransform* X_WP,
                  const LocalTime& arrival, std::size_t hand) {
  Hand& input = hands_.at(hand);
  const bool relocation = result == GateResult::relocation;
  if (relocation) input.smoothing.restart();
  motion::PoseSample smoothed = input.smoothing.filter(sample);
  if (X_WP != nullptr) smoothed.X = *X_WP * smoothed.X;
  const double simulated_until = has_sample_ ? simulation_.time() : kNever;
  for (const motion::PoseSample& followed : input.reacquisition.follow(smoothed, relocation, simulated_until)) {
    input.has_sample |= simulation_.push_stylus(followed, hand);
  }
  has_sample_ |= input.has_sample;
  input.playout.sample(sample.t, arrival);  // a late one, too: simulated time waits for what is under way
}

void Feed::restart_gate(std::size_t hand) {
  hands_.at(hand).gate.restart();
  hands_.at(hand).smoothing.restart();
}

void Feed::buttons_known(double t, const LocalTime& arrival, std::size_t hand) {
  hands_.at(hand).playout.buttons(t, arrival);
}

double Feed::target(const LocalTime& now) const {
  double target = std::numeric_limits<double>::infinity();
  for (const Hand& hand : hands_) {
    if (hand.has_sample) target = std::min(target, hand.playout.target(now));
  }
  return std::isfinite(target) ? target : kNever;
}

simulation::AdvanceReport Feed::advance_to(double t) {
  std::multimap<double, std::size_t> releases;
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
    while (const auto release = hands_[hand].reacquisition.take_release(t)) releases.emplace(*release, hand);
  }
  simulation::AdvanceReport report;
  for (const auto& [at, hand] : releases) {
    report.add(simulation_.advance(std::max(at, simulation_.time())));
    simulation_.release(hand);
  }
  report.add(simulation_.advance(t));
  return report;
}

void Feed::restart() {
  for (Hand& hand : hands_) {
    hand.playout.clear();
    hand.reacquisition.restart();
    hand.has_sample = false;
  }
  has_sample_ = false;
}

}  // namespace spring_workbench::hand_input
