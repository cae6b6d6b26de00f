#include "spring_workbench/hand_input/input_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "constants.h"
#include "spring_workbench/hand_input/dead_band.h"
#include "spring_workbench/hand_input/playout_clock.h"
#include "spring_workbench/hand_input/pose_filter.h"
#include "spring_workbench/motion/pose_predictor.h"
#include "spring_workbench/validation/element.h"

namespace spring_workbench::hand_input {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

using Kind = AcceptedInput::Kind;
using motion::ButtonEdge;
constexpr std::pair<ButtonEdge, Kind> of_buttons[] = {{ButtonEdge::grasp, Kind::button_down},
                                                      {ButtonEdge::release, Kind::button_up},
                                                      {ButtonEdge::next_tool, Kind::next_tool},
                                                      {ButtonEdge::clutch_on, Kind::clutch_on},
                                                      {ButtonEdge::clutch_off, Kind::clutch_off}};

}  // namespace

Kind AcceptedInput::kind_of(ButtonEdge edge) {
  return std::find_if(std::begin(of_buttons), std::end(of_buttons), [&](auto& b) { return b.first == edge; })->second;
}

std::optional<ButtonEdge> AcceptedInput::edge_of(Kind kind) {
  for (const auto& [edge, of_edge] : of_buttons) {
    if (of_edge == kind) return edge;
  }
  return std::nullopt;
}

struct InputFilter::Hand {
  SampleGate gate;
  PoseFilter smoothing;
  DeadBand dead_band;
  Reacquisition reacquisition;
  PlayoutClock playout;
  std::optional<motion::PosePredictor> ahead;  ///< if its motion is predicted
  bool has_sample = false;                     ///< whether a sample has arrived since the start
  std::optional<RigidTransform> X_WP;          ///< pose of the tracker at the newest sample
  std::size_t tracker_moves = 0;
};

InputFilter::InputFilter(simulation::Simulation& simulation, const InputSettings& settings, Prediction prediction)
    : simulation_(simulation) {
  const double dropout_after = simulation.settings().dropout_after;
  const Hand hand{SampleGate(settings, dropout_after),
                  PoseFilter(settings),
                  DeadBand(settings),
                  Reacquisition(settings),
                  PlayoutClock(dropout_after),
                  prediction == Prediction::on ? std::make_optional<motion::PosePredictor>() : std::nullopt,
                  false,
                  {},
                  0};
  hands_.assign(simulation.hands(), hand);
}

InputFilter::~InputFilter() = default;

const InputFilter::Hand& InputFilter::hand_at(std::size_t index) const {
  return validation::element(hands_, index, "hand");
}
InputFilter::Hand& InputFilter::hand_at(std::size_t index) { return validation::element(hands_, index, "hand"); }

const GateCounts& InputFilter::gate_counts(std::size_t hand) const { return hand_at(hand).gate.counts(); }
const ReacquisitionCounts& InputFilter::reacquisition_counts(std::size_t hand) const {
  return hand_at(hand).reacquisition.counts();
}

std::size_t InputFilter::tracker_moves(std::size_t hand) const { return hand_at(hand).tracker_moves; }

GateResult InputFilter::push_stylus(const RawSample& sample, const RigidTransform& X_WP, const LocalTime& arrival,
                                    std::size_t hand) {
  const GateResult result = hand_at(hand).gate.offer(sample);
  if (usable(result)) follow({sample.t, make_transform(sample.p, sample.q)}, result, &X_WP, arrival, hand);
  return result;
}

GateResult InputFilter::push_stylus(const motion::PoseSample& sample, std::size_t hand, double quaternion_norm) {
  const Quaterniond q(quaternion_norm * Quaterniond(sample.X.linear()).coeffs());
  const GateResult result = hand_at(hand).gate.offer({sample.t, sample.X.translation(), q});
  if (usable(result)) follow(sample, result, nullptr, {}, hand);
  return result;
}

/// `X_WP`: null if the sample is in world.
void InputFilter::follow(const motion::PoseSample& sample, GateResult result, const RigidTransform* X_WP,
                         const LocalTime& arrival, std::size_t hand) {
  Hand& input = hand_at(hand);
  const bool tracker_moved = X_WP != nullptr && input.X_WP && input.X_WP->matrix() != X_WP->matrix();
  if (X_WP != nullptr) input.X_WP = *X_WP;
  input.tracker_moves += tracker_moved ? 1 : 0;
  const bool relocation = result == GateResult::relocation || tracker_moved;
  if (relocation) {
    input.smoothing.restart();
    input.dead_band.restart();
  }
  motion::PoseSample smoothed = input.dead_band.filter(input.smoothing.filter(sample));
  if (X_WP != nullptr) smoothed.X = *X_WP * smoothed.X;
  const double simulated_until = has_sample_ ? simulation_.time() : kNever;
  if (relocation && input.ahead) input.ahead->restart();
  for (const motion::PoseSample& followed : input.reacquisition.follow(smoothed, relocation, simulated_until)) {
    if (!simulation_.push_stylus(followed, hand)) continue;
    input.has_sample = true;
    if (input.ahead) input.ahead->push(followed);
    note(AcceptedInput::Kind::pose, hand, followed.t, followed.X);
  }
  has_sample_ |= input.has_sample;
  input.playout.add_sample(sample.t, arrival);  // even if it is late: later samples may still arrive
}

void InputFilter::report_arrival(const LocalTime& arrival, std::size_t hand) {
  hand_at(hand).playout.report_arrival(arrival);
}

void InputFilter::restart_gate(std::size_t hand) {
  Hand& input = hand_at(hand);
  input.gate.restart();
  input.smoothing.restart();
  input.dead_band.restart();
}

void InputFilter::confirm_buttons(double t, const LocalTime& arrival, std::size_t hand) {
  hand_at(hand).playout.confirm_buttons(t, arrival);
}

void InputFilter::push_edge(double t, motion::ButtonEdge edge, std::size_t hand) {
  simulation_.push_edge(t, edge, hand);
  note(AcceptedInput::kind_of(edge), hand, t);
}

void InputFilter::push_external_wrench(const motion::ExternalWrench& sample, std::size_t hand) {
  simulation_.push_external_wrench(sample, hand);
  if (record_)
    record_({Kind::external_wrench, hand, sample.t, RigidTransform::Identity(), sample, committed(), target()});
}

void InputFilter::note(AcceptedInput::Kind kind, std::size_t hand, double t, const RigidTransform& X_WS) const {
  if (record_) record_({kind, hand, t, X_WS, {}, committed(), target()});
}

double InputFilter::committed() const { return began_ ? simulation_.time() : kNever; }

std::optional<double> InputFilter::next_target(const LocalTime& now) const {
  if (target_) return target_;
  double known = -kNever, rests = kNever;
  for (const Hand& hand : hands_) {
    if (!hand.has_sample) continue;
    known = std::min(known, hand.playout.complete_until(now));
    rests = std::max(rests, hand.playout.rests_until(now));
  }
  const bool silent = has_sample_ && known == -kNever;
  const double limit = silent ? rests : known, event = simulation_.next_event_time();
  if (has_sample_ && event <= limit) return event;
  const double step_end = simulation_.time() + simulation_.settings().dynamics.step;
  return silent && step_end <= rests ? std::make_optional(step_end) : std::nullopt;
}

simulation::AdvanceReport InputFilter::advance_to(double t, double pause_at) {
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
    while (const auto release = hands_[hand].reacquisition.take_release(t)) releases_.emplace(*release, hand);
  }
  simulation::AdvanceReport report;
  const auto reach = [&](double end) {
    const double event = simulation_.next_event_time();
    report.add(simulation_.advance_to(end, pause_at));
    began_ = true;
    const double left = simulation_.settings().hand_time_scale * (end - simulation_.time());
    const bool is_interrupted = pause_at < end && left >= same_time;
    target_ = is_interrupted ? std::make_optional(end) : std::nullopt;
    if (!is_interrupted && event > end) note(AcceptedInput::Kind::rest, 0, end);
    return !is_interrupted;
  };
  while (!releases_.empty() && releases_.begin()->first <= t) {
    const auto [at, hand] = *releases_.begin();
    if (!reach(std::max(at, simulation_.time()))) return report;
    releases_.erase(releases_.begin());
    simulation_.release(hand);
    note(AcceptedInput::Kind::lost, hand, at);
  }
  reach(t);
  return report;
}

void InputFilter::predict(double t, simulation::Simulation& copy) const {
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
    if (!hands_[hand].ahead) continue;
    for (const motion::PoseSample& sample : hands_[hand].ahead->continuation(t)) copy.push_stylus(sample, hand);
  }
}

double InputFilter::time_since_arrival(const LocalTime& now) const {
  const auto newest = std::max_element(hands_.begin(), hands_.end(), [](const Hand& a, const Hand& b) {
    return a.playout.newest() < b.playout.newest();
  });
  return std::isfinite(newest->playout.newest()) ? newest->playout.time_since_arrival(now) : 0.0;
}

void InputFilter::restart() {
  for (Hand& hand : hands_) {
    hand.playout.clear();
    hand.reacquisition.restart();
    if (hand.ahead) hand.ahead->restart();
    hand.has_sample = false;
  }
  has_sample_ = began_ = false;
  target_.reset();
  releases_.clear();
}

}  // namespace spring_workbench::hand_input
