#include "spring_workbench/ros/manipulation/simulation_runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace spring_workbench::manipulation {
namespace {

constexpr double kSlack = 1e-6;  // of a grid step

}  // namespace

SimulationRunner::SimulationRunner(const scene::Scene& scene, const simulation::SimulationSettings& settings,
                                   const hand_input::TruthSettings& truth, double grid)
    : simulation_(std::make_unique<simulation::Simulation>(scene, settings)), task_(scene), grid_(grid) {
  for (std::size_t hand = 0; hand < simulation::Simulation::most_hands; ++hand) {
    inputs_.emplace_back(hand, truth, settings.dropout_after, grid > 0.0);
  }
}

CycleReport SimulationRunner::cycle(const HandEvents& events, const hand_input::LocalTime& now) {
  constexpr double longest_catch_up = 5.0;  // [s] beyond this, time has leapt
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto begin = std::chrono::steady_clock::now();
  for (HandInput& input : inputs_) {
    input.waiting.insert(input.waiting.end(), events[input.hand].begin(), events[input.hand].end());
  }
  feed(now);
  CycleReport report;
  const double target = this->target(now);
  if (has_sample_ && target > simulation_->time() + longest_catch_up) {
    start_anew();
    report.leapt = true;
  } else if (has_sample_ && target > simulation_->time()) {
    advance(target, report);
  }
  for (const HandInput& input : inputs_) report.more |= !input.waiting.empty();
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

void SimulationRunner::feed(const hand_input::LocalTime& now) {
  for (HandInput& input : inputs_) {
    while (!input.waiting.empty()) {
      const auto* epoch = std::get_if<NewEpoch>(&input.waiting.front());
      const bool restarts = epoch != nullptr && !joins(input, *epoch);
      if (restarts && grid_ > 0.0 && has_sample_ && has_more(target(now))) break;
      // What comes from before a jump of time that another hand has told of already is of no use.
      if (input.in_epoch || epoch != nullptr)
        std::visit([&](const auto& e) { apply(input, e); }, input.waiting.front());
      input.waiting.pop_front();
    }
  }
}

/// As far as the slowest hand allows.
double SimulationRunner::target(const hand_input::LocalTime& now) const {
  double target = std::numeric_limits<double>::infinity();
  for (const HandInput& input : inputs_) {
    if (input.has_sample) target = std::min(target, input.playout.target(now) + input.shift);
  }
  return std::isfinite(target) ? target : -std::numeric_limits<double>::infinity();
}

/// Whether the next step of the grid lies before the target, not on it: there the segment begins whose velocity hangs
/// on a sample that may not be here yet.
bool SimulationRunner::has_more(double target) const { return next_on_grid() <= target - kSlack * grid_; }

double SimulationRunner::next_on_grid() const {
  return grid_ * (std::floor(simulation_->time() / grid_ + kSlack) + 1.0);
}

void SimulationRunner::advance(double target, CycleReport& report) {
  if (grid_ > 0.0) {
    if (!has_more(target)) return;
    const double next = next_on_grid();
    report.more = next + grid_ <= target - kSlack * grid_;
    target = next;
  }
  const auto release = take_release(target);
  if (release) {
    target = std::max(release->t, simulation_->time());
    report.more = true;
  }
  report.advance = simulation_->advance(target);
  if (release) simulation_->release(release->hand);
  task_.observe(*simulation_);
}

std::optional<SimulationRunner::Loss> SimulationRunner::take_release(double target) {
  for (HandInput& input : inputs_) {
    if (const auto release = input.reengagement.take_release(target - input.shift))
      return Loss{*release + input.shift, input.hand};
  }
  return std::nullopt;
}

/// Whether a stylus that begins there comes to the others that are under way, rather than that all time has jumped.
bool SimulationRunner::joins(const HandInput& input, const NewEpoch& epoch) const {
  constexpr double slip = 1.5;  // [s]: in simulated time an epoch begins at the whole second before its first sample
  return has_sample_ && !input.in_epoch && (epoch.zero - zero_).toSec() > simulation_->time() - slip;
}

void SimulationRunner::apply(HandInput& input, const NewEpoch& epoch) {
  if (!joins(input, epoch)) {
    start_anew();
    simulation_->place(std::exchange(places_, {}));
    zero_ = epoch.zero;
    for (HandInput& other : inputs_) other.in_epoch = false;
  }
  input.in_epoch = true;
  input.shift = (epoch.zero - zero_).toSec();
}

void SimulationRunner::apply(HandInput& input, const StylusPose& pose) {
  constexpr double never = -std::numeric_limits<double>::infinity();
  const double simulated_until = has_sample_ ? simulation_->time() - input.shift : never;
  for (motion::PoseSample sample : input.reengagement.follow(pose.sample, pose.new_place, simulated_until)) {
    sample.t += input.shift;
    input.has_sample |= simulation_->push_stylus(sample, input.hand);
  }
  has_sample_ |= input.has_sample;
  input.playout.sample(pose.sample.t, pose.arrival);  // a late one, too: simulated time waits for what is under way
}

void SimulationRunner::apply(HandInput& input, const StylusButton& button) {
  simulation_->push_button(button.t + input.shift, button.pressed, input.hand);
}

void SimulationRunner::apply(HandInput& input, const NextTool& press) {
  simulation_->push_next_tool(press.t + input.shift, input.hand);
}

void SimulationRunner::apply(HandInput& input, const ButtonsKnown& known) {
  input.playout.buttons(known.t, known.arrival);
}

void SimulationRunner::start_anew() {
  simulation_->reset();
  task_.reset();
  forget_hands();
}

void SimulationRunner::forget_hands() {
  for (HandInput& input : inputs_) {
    input.playout.clear();
    input.reengagement.restart();
    input.has_sample = false;
  }
  has_sample_ = false;
}

void SimulationRunner::restart() {
  const std::lock_guard<std::mutex> lock(mutex_);
  places_.clear();
  start_anew();
}

void SimulationRunner::load(const scene::Scene& scene) {
  resume(scene, [](simulation::Simulation&) {}, {});
}

void SimulationRunner::resume(const scene::Scene& scene, const std::function<void(simulation::Simulation&)>& prepare,
                              const std::map<std::string, RigidTransform>& X_WO) {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto simulation = std::make_unique<simulation::Simulation>(scene, simulation_->settings());
  prepare(*simulation);
  simulation->place(X_WO);
  task_ = assembly::TaskMonitor(scene);
  simulation_ = std::move(simulation);
  places_ = X_WO;
  forget_hands();
}

ros::Time SimulationRunner::stamp(const ros::Time& now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return has_sample_ ? zero_ + ros::Duration(simulation_->time()) : now;
}

hand_input::ReengagementCounts SimulationRunner::hand_counts(std::size_t hand) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return inputs_.at(hand).reengagement.counts();
}

}  // namespace spring_workbench::manipulation
