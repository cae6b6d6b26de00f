#include "spring_workbench/ros_interface/simulation_runner.h"

#include <chrono>

namespace spring_workbench {

SimulationRunner::SimulationRunner(const Scene& scene, const SimulationSettings& settings)
    : simulation_(std::make_unique<Simulation>(scene, settings)), task_(scene), playout_(settings.dropout_after) {}

CycleReport SimulationRunner::cycle(const std::vector<StylusEvent>& events, double now) {
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
    report.advance = simulation_->advance(target);
    task_.observe(*simulation_);
  }
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

void SimulationRunner::apply(const NewEpoch& epoch) {
  start_anew();
  zero_ = epoch.zero;
}

void SimulationRunner::apply(const StylusPose& pose) {
  if (!simulation_->push_stylus(pose.sample)) return;
  playout_.sample(pose.sample.t, pose.arrival);
  has_sample_ = true;
}

void SimulationRunner::apply(const StylusButton& button) { simulation_->push_button(button.t, button.pressed); }

void SimulationRunner::start_anew() {
  simulation_->reset();
  task_.reset();
  playout_.clear();
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
  has_sample_ = false;
}

ros::Time SimulationRunner::stamp(const ros::Time& now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return has_sample_ ? zero_ + ros::Duration(simulation_->time()) : now;
}

}  // namespace spring_workbench
