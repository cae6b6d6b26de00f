#include "spring_workbench/ros/manipulation/simulation_runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "constants.h"

namespace spring_workbench::manipulation {

SimulationRunner::SimulationRunner(const scene::Scene& scene, const simulation::SimulationSettings& settings,
                                   const hand_input::InputSettings& input, double grid)
    : simulation_(scene, settings), feed_(simulation_, input, grid > 0.0), task_(scene), grid_(grid) {
  for (std::size_t hand = 0; hand < simulation::Simulation::most_hands; ++hand) {
    inputs_.emplace_back(hand, settings.dropout_after);
  }
}

CycleReport SimulationRunner::cycle(const HandEvents& events, const hand_input::LocalTime& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto begin = std::chrono::steady_clock::now();
  for (HandInput& input : inputs_) {
    input.waiting.insert(input.waiting.end(), events[input.hand].begin(), events[input.hand].end());
  }
  feed(now);
  CycleReport report;
  const double target = feed_.target(now);
  if (target > simulation_.time() + longest_catch_up) {
    start_anew();
    report.leapt = true;
  } else if (target > simulation_.time()) {
    advance(target, report);
  }
  for (HandInput& input : inputs_) {
    report.more |= !input.waiting.empty();
    report.rejected[input.hand] = std::exchange(input.rejected, {});
  }
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

void SimulationRunner::feed(const hand_input::LocalTime& now) {
  for (HandInput& input : inputs_) {
    while (!input.waiting.empty()) {
      const auto* epoch = std::get_if<NewEpoch>(&input.waiting.front());
      const bool restarts = epoch != nullptr && !joins(input, *epoch);
      if (restarts && grid_ > 0.0 && has_more(feed_.target(now))) break;
      // What comes from before a jump of time that another hand has told of already is of no use.
      if (input.in_epoch || epoch != nullptr)
        std::visit([&](const auto& e) { apply(input, e); }, input.waiting.front());
      input.waiting.pop_front();
    }
  }
}

/// Whether the next step of the grid lies before the target, not on it: there the segment begins whose velocity hangs
/// on a sample that may not be here yet.
bool SimulationRunner::has_more(double target) const { return next_on_grid() <= target - grid_slack * grid_; }

double SimulationRunner::next_on_grid() const {
  return grid_ * (std::floor(simulation_.time() / grid_ + grid_slack) + 1.0);
}

void SimulationRunner::advance(double target, CycleReport& report) {
  if (grid_ > 0.0) {
    if (!has_more(target)) return;
    const double next = next_on_grid();
    report.more = next + grid_ <= target - grid_slack * grid_;
    target = next;
  }
  report.advance = feed_.advance_to(target);
  task_.observe(simulation_);
}

/// Whether a stylus that begins there comes to the others that are under way, rather than that all time has jumped.
bool SimulationRunner::joins(const HandInput& input, const NewEpoch& epoch) const {
  return feed_.has_sample() && !input.in_epoch && (epoch.zero - zero_).toSec() > simulation_.time() - joining_slip;
}

void SimulationRunner::apply(HandInput& input, const NewEpoch& epoch) {
  if (!joins(input, epoch)) {
    start_anew();
    simulation_.place(std::exchange(places_, {}));
    zero_ = epoch.zero;
    for (HandInput& other : inputs_) other.in_epoch = false;
  }
  feed_.restart_gate(input.hand);
  input.monitor.restart();
  input.in_epoch = true;
  input.shift = (epoch.zero - zero_).toSec();
}

void SimulationRunner::apply(HandInput& input, const StylusPose& pose) {
  hand_input::RawSample sample = pose.sample;
  sample.t += input.shift;
  const hand_input::GateResult result = feed_.push_stylus(sample, pose.X_WP, pose.arrival, input.hand);
  if (!hand_input::usable(result)) return input.rejected.push_back({result, pose});
  input.monitor.sample(sample.t, sample.t + pose.age);
  input.newest_arrival = pose.arrival.loop;
}

void SimulationRunner::apply(HandInput& input, const StylusButton& button) {
  feed_.push_button(button.t + input.shift, button.pressed, input.hand);
}

void SimulationRunner::apply(HandInput& input, const NextTool& press) {
  feed_.push_next_tool(press.t + input.shift, input.hand);
}

void SimulationRunner::apply(HandInput& input, const ButtonsKnown& known) {
  feed_.buttons_known(known.t + input.shift, known.arrival, input.hand);
}

void SimulationRunner::start_anew() {
  simulation_.reset();
  task_.reset();
  feed_.restart();
}

void SimulationRunner::restart() {
  const std::lock_guard<std::mutex> lock(mutex_);
  places_.clear();
  start_anew();
}

void SimulationRunner::load(const scene::Scene& scene) {
  const std::lock_guard<std::mutex> lock(mutex_);
  simulation::Simulation simulation(scene, simulation_.settings());
  for (std::size_t hand = 0; hand < simulation::Simulation::most_hands; ++hand) {
    simulation::ForkChange change = simulation::change_to(simulation_.fork_settings(hand));
    if (simulation.settings().grasp.calibrate == tools::Calibration::world) {  // the fork is the new scene's
      change.stretch_stiffness = change.bend_stiffness = change.torsion_stiffness = std::nullopt;
    }
    simulation.change(change, hand);
  }
  places_.clear();
  begin_with(std::move(simulation));
}

void SimulationRunner::resume(const scene::Scene& scene, const simulation::SimulationState& state) {
  const std::lock_guard<std::mutex> lock(mutex_);
  simulation::Simulation simulation(scene, simulation_.settings());
  simulation.restore(state);
  std::map<std::string, RigidTransform> places;
  for (const bodies::BodyState& object : simulation.objects()) places[object.name] = object.X_WO;
  simulation.reset();
  simulation.place(places);
  places_ = std::move(places);
  begin_with(std::move(simulation));
}

void SimulationRunner::begin_with(simulation::Simulation simulation) {
  task_ = assembly::TaskMonitor(simulation.scene());
  simulation_ = std::move(simulation);
  feed_.restart();
}

ros::Time SimulationRunner::stamp(const ros::Time& now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return feed_.has_sample() ? zero_ + ros::Duration(simulation_.time()) : now;
}

HandStatistics SimulationRunner::hand_statistics(std::size_t hand) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const HandInput& input = inputs_.at(hand);
  return {input.monitor.figures(), feed_.gate_counts(hand), feed_.reacquisition_counts(hand), input.newest_arrival};
}

}  // namespace spring_workbench::manipulation
