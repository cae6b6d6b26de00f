#include "spring_workbench/ros_interface/simulation_runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace spring_workbench {

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
  for (const StylusEvent& event : events) std::visit([this](const auto& e) { apply(e); }, event);
  CycleReport report;
  const double target = playout_.target(now);
  if (has_sample_ && target > simulation_->time() + longest_catch_up) {
    start_anew();
    report.leapt = true;
  } else if (has_sample_ && target > simulation_->time()) {
    advance(target, report);
  }
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

void SimulationRunner::advance(double target, CycleReport& report) {
  if (grid_ > 0.0) {
    constexpr double slack = 1e-6;  // of a grid step
    const double next = grid_ * (std::floor(simulation_->time() / grid_ + slack) + 1.0);
    // Before the target, not onto it: there the segment begins whose velocity hangs on a sample that may not be here yet.
    if (next > target - slack * grid_) return;
    report.more = next + grid_ <= target - slack * grid_;
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
