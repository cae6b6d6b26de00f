#include "spring_workbench/ros_interface/simulation_runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace spring_workbench {
namespace {

constexpr double kSlack = 1e-6;  // of a grid step

}  // namespace

SimulationRunner::SimulationRunner(const Scene& scene, const SimulationSettings& settings, const TruthSettings& truth,
                                   double grid)
    : simulation_(std::make_unique<Simulation>(scene, settings)),
      task_(scene),
      playout_(settings.dropout_after, grid > 0.0),
      hand_(truth),
      grid_(grid) {}

CycleReport SimulationRunner::cycle(const std::vector<StylusEvent>& events, const LocalTime& now) {
  constexpr double longest_catch_up = 5.0;  // [s] beyond this, time has leapt
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto begin = std::chrono::steady_clock::now();
  waiting_.insert(waiting_.end(), events.begin(), events.end());
  feed(now);
  CycleReport report;
  const double target = playout_.target(now);
  if (has_sample_ && target > simulation_->time() + longest_catch_up) {
    start_anew();
    report.leapt = true;
  } else if (has_sample_ && target > simulation_->time()) {
    advance(target, report);
  }
  report.more |= !waiting_.empty();
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

void SimulationRunner::feed(const LocalTime& now) {
  while (!waiting_.empty()) {
    const bool new_epoch = std::holds_alternative<NewEpoch>(waiting_.front());
    if (new_epoch && grid_ > 0.0 && has_sample_ && has_more(playout_.target(now))) return;
    std::visit([this](const auto& e) { apply(e); }, waiting_.front());
    waiting_.pop_front();
  }
}

/// Whether the next step of the grid lies before the target, not on it: there the segment begins whose velocity hangs on
/// a sample that may not be here yet.
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
  const std::optional<double> release = hand_.take_release(target);
  if (release) {
    target = std::max(*release, simulation_->time());
    report.more = true;
  }
  report.advance = simulation_->advance(target);
  if (release) simulation_->release();
  task_.observe(*simulation_);
}

void SimulationRunner::apply(const NewEpoch& epoch) {
  start_anew();
  zero_ = epoch.zero;
}

void SimulationRunner::apply(const StylusPose& pose) {
  constexpr double never = -std::numeric_limits<double>::infinity();
  const double simulated_until = has_sample_ ? simulation_->time() : never;
  for (const PoseSample& sample : hand_.follow(pose.sample, pose.new_place, simulated_until)) {
    has_sample_ |= simulation_->push_stylus(sample);
  }
  playout_.sample(pose.sample.t, pose.arrival);  // a late one, too: simulated time waits for what is under way
}

void SimulationRunner::apply(const StylusButton& button) { simulation_->push_button(button.t, button.pressed); }

void SimulationRunner::apply(const ButtonsKnown& known) { playout_.buttons(known.t, known.arrival); }

void SimulationRunner::start_anew() {
  simulation_->reset();
  task_.reset();
  playout_.clear();
  hand_.restart();
  has_sample_ = false;
}

void SimulationRunner::restart() {
  const std::lock_guard<std::mutex> lock(mutex_);
  start_anew();
}

void SimulationRunner::load(const Scene& scene) {
  const std::lock_guard<std::mutex> lock(mutex_);
  simulation_ = std::make_unique<Simulation>(scene, simulation_->settings());
  task_ = TaskMonitor(scene);
  playout_.clear();
  hand_.restart();
  has_sample_ = false;
}

ros::Time SimulationRunner::stamp(const ros::Time& now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return has_sample_ ? zero_ + ros::Duration(simulation_->time()) : now;
}

ReengagementCounts SimulationRunner::hand_counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return hand_.counts();
}

}  // namespace spring_workbench
