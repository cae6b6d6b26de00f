#include "spring_workbench/live/simulation_runner.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "constants.h"

namespace spring_workbench::live {
/// Scope guard around a change of the simulation: its destructor writes the state after the change to the journal.
class SimulationRunner::RecordedChange {
 public:
  RecordedChange(SimulationRunner& runner, const std::string& what, const Command& command)
      : runner_(runner), change_{what, command, "", 0, {}} {
    if (runner_.keeps_journal_) change_.hash_before = runner_.simulation_.state_hash();
  }
  ~RecordedChange() {
    ++runner_.revision_;
    runner_.ahead_.restart();
    if (!runner_.keeps_journal_) return;
    change_.scene = runner_.simulation_.scene().path;
    change_.state = runner_.simulation_.save();
    runner_.journal_.note(committed_, target_, runner_.stamp(), change_);
  }

 private:
  SimulationRunner& runner_;
  const double committed_ = runner_.filter_.committed(), target_ = runner_.filter_.target();
  Change change_;
};

SimulationRunner::SimulationRunner(const scene::Scene& scene, const simulation::SimulationSettings& settings,
                                   const hand_input::InputSettings& input, bool simulated_time, Pace pace)
    : simulation_(scene, settings),
      filter_(simulation_, input, hand_input::InputFilter::Prediction::on),
      ahead_(scene, settings),
      scene_(std::make_shared<const scene::Scene>(simulation_.scene())),
      task_(scene),
      simulated_time_(simulated_time),
      pace_(std::move(pace)),
      times_(simulation_.hands(), simulated_time) {
  for (std::size_t hand = 0; hand < simulation_.hands(); ++hand) inputs_.emplace_back(hand, settings.dropout_after);
}

NextScene::NextScene(std::mutex& changing, const Make& make)
    : one_at_a_time(changing), committed(make()), shown(committed ? make() : std::nullopt) {
  if (!committed) return;
  scene = std::make_shared<const spring_workbench::scene::Scene>(committed->scene());
  task.emplace(*scene);
}

void HandInput::add_to(CycleReport& report) {
  report.more |= !waiting.empty();
  report.rejected.push_back(std::exchange(rejected, {}));
  report.input_age = std::max(report.input_age, newest_age);
}

void HandInput::used(double t, const StylusPose& pose) {
  monitor.sample(t, t + pose.age);
  newest_arrival = pose.arrival.loop;
  newest_age = pose.age;
}

void Work::add(const Work& later) {
  advance.add(later.advance);
  wall_time += later.wall_time;
  prediction.position = std::max(prediction.position, later.prediction.position);
  prediction.angle = std::max(prediction.angle, later.prediction.angle);
}

CycleReport SimulationRunner::cycle(const HandEvents& events, const hand_input::LocalTime& now) {
  const Lock lock(mutex_);
  const double begin = pace_.now();
  for (const auto& [hand, came] : events)
    std::copy(came.begin(), came.end(), std::back_inserter(inputs_.at(hand).waiting));
  feed(now);
  if (!filter_.is_interrupted()) work_ = {};
  CycleReport report;
  report.time_skipped = times_.take_skipped();
  std::optional<double> stop = filter_.next_target(now);
  for (bool silent = true; silent && stop; stop = filter_.next_target(now)) {
    silent = *stop < simulation_.next_event_time() && pace_.now() - begin < longest_cycle;
    const double pause = pace_.end_of_cycle(filter_.committed(), *stop, simulation_.settings().dynamics.step);
    report.add({filter_.advance_to(*stop, pause), 0.0, ahead_.compare(simulation_)});
    task_.observe(simulation_);
    ++revision_;
  }
  report.more = stop.has_value();
  for (HandInput& input : inputs_) input.add_to(report);
  report.input_age += filter_.time_since_arrival(now);
  report.wall_time = pace_.now() - begin;
  work_.add(report);
  const double lag = simulation_.newest_sample_time() - simulation_.time();
  if (!simulated_time_) pace_.committed(report.advance.simulated_time, report.wall_time, lag);
  if (!report.more) pace_.caught_up();
  report.behind = pace_.is_behind();
  return report;
}

void SimulationRunner::feed(const hand_input::LocalTime& now) {
  for (HandInput& input : inputs_) {
    while (!input.waiting.empty()) {
      const auto* epoch = std::get_if<NewEpoch>(&input.waiting.front());
      const bool restarts = epoch != nullptr && !joins(input, *epoch);
      if (restarts && simulated_time_ && filter_.next_target(now)) break;
      if (times_.knows(input.hand) || epoch != nullptr) feed(input, input.waiting.front());  // else from before a jump
      input.waiting.pop_front();
    }
  }
}

/// While behind, poses are dropped, and buttons and sensors act at the time of the newest accepted pose.
void SimulationRunner::feed(HandInput& input, const StylusEvent& event) {
  was_behind_ |= pace_.is_behind();
  if (!std::holds_alternative<ButtonsKnown>(event)) ahead_.input_changed();
  if (!pace_.is_behind() || std::holds_alternative<NewEpoch>(event))
    return std::visit([&](const auto& e) { apply(input, e); }, event);
  const double newest = simulation_.newest_sample_time();
  if (const auto* pose = std::get_if<StylusPose>(&event)) filter_.report_arrival(pose->arrival, input.hand);
  if (const auto* button = std::get_if<StylusButton>(&event)) filter_.push_edge(newest, button->edge, input.hand);
  if (const auto* wrench = std::get_if<StylusWrench>(&event)) push(input, *wrench, newest);
}

std::optional<Shown> SimulationRunner::show(double latency, const hand_input::LocalTime& now, const Wanted& wanted) {
  const Lock lock(mutex_);
  const double horizon =
      latency > 0.0 ? std::min(latency + filter_.time_since_arrival(now), motion::PosePredictor::farthest) : 0.0;
  const double beyond = ahead_.show_newest(simulation_, filter_, horizon, pace_);
  const simulation::Simulation& shown = ahead_.shown();
  const Progress at = progress_at(shown.time(), filter_.has_sample());
  if (!ahead_.has_followed() || !wanted(at)) return std::nullopt;
  return Shown{{at, view_of(shown, scene_, shown_objects_)}, beyond};
}

std::optional<Committed> SimulationRunner::committed(const Wanted& wanted) const {
  const Lock lock(mutex_);
  const Progress at = progress_at(simulation_.time(), std::isfinite(filter_.committed()));
  if (!wanted(at)) return std::nullopt;
  return Committed{{at, view_of(simulation_, scene_, objects_)}, task_.placements(), task_.score(), work_};
}

bool SimulationRunner::joins(const HandInput& input, const NewEpoch& epoch) const {
  return (filter_.has_sample() || !simulated_time_) && times_.joins(input.hand, epoch.zero, simulation_.time());
}

void SimulationRunner::apply(HandInput& input, const NewEpoch& epoch) {
  if (joins(input, epoch)) {
    times_.join(input.hand, epoch.zero);
  } else {
    Command command(Command::Kind::restart);
    command.places = places_;
    const RecordedChange noted(*this, "the hand's time begins", command);
    undo_.perform(command, simulation_);
    restart_time();
    times_.begin(input.hand, epoch.zero);
  }
  filter_.restart_gate(input.hand);
  input.monitor.restart();
}

/// A hand's time as simulation time [s]. If too far ahead, all hands' times move to a step after the newest input.
double SimulationRunner::time_of(const HandInput& input, double t) {
  const double ahead = times_.time_of(input.hand, t) - std::max(simulation_.time(), simulation_.newest_sample_time());
  if (filter_.has_sample() && ahead > (was_behind_ ? 0.0 : longest_catch_up)) {
    was_behind_ = false;
    times_.skip(std::max(ahead - simulation_.settings().dynamics.step, 0.0));
    for (const HandInput& other : inputs_) filter_.restart_gate(other.hand);
  }
  return times_.time_of(input.hand, t);
}

void SimulationRunner::apply(HandInput& input, const StylusPose& pose) {
  hand_input::RawSample sample = pose.sample;
  if (std::isfinite(sample.t)) sample.t = time_of(input, sample.t);
  const hand_input::GateResult result = filter_.push_stylus(sample, pose.X_WP, pose.arrival, input.hand);
  if (!hand_input::usable(result)) return input.rejected.push_back({result, pose});
  input.used(sample.t, pose);
}

void SimulationRunner::apply(HandInput& input, const StylusButton& button) {
  filter_.push_edge(time_of(input, button.t), button.edge, input.hand);
}

void SimulationRunner::apply(HandInput& input, const ButtonsKnown& known) {
  filter_.confirm_buttons(time_of(input, known.t), known.arrival, input.hand);
}

void SimulationRunner::push(HandInput& input, StylusWrench wrench, double t) {
  wrench.sample.t = t;
  filter_.push_external_wrench(wrench.sample, input.hand);
}

void SimulationRunner::restart_time() {
  places_.clear();
  task_.reset();
  filter_.restart();
  ahead_.allow_time_back();
}

ChangeReport SimulationRunner::change(const std::string& what, const Command& command) {
  NextScene next(changing_, [&] { return undo_.prepare(command, simulation_); });
  return change_to(next, what, command, [&] {
    if (!simulated_time_) pace_.changed();
    ChangeReport report = undo_.perform(command, simulation_, next.committed);
    if (command.kind == Command::Kind::undo || command.kind == Command::Kind::edit) task_.reset();
    if (command.kind == Command::Kind::reset) restart_time();
    return report;
  });
}

ChangeReport SimulationRunner::load(const scene::Scene& scene) {
  NextScene next(changing_, [&] { return simulation::Simulation(scene, settings()); });
  return begin_with(next, "load_scene", Command(Command::Kind::load_scene));
}

void SimulationRunner::resume(const scene::Scene& scene, const simulation::SimulationState& state) {
  NextScene next(changing_, [&] {
    simulation::Simulation simulation(scene, settings());
    simulation.restore(state);
    return simulation;
  });
  next.places = put_to_rest(*next.committed, next.committed->time());
  begin_with(next, "resume", {});
}

ChangeReport SimulationRunner::begin_with(NextScene& next, const std::string& what, const Command& command) {
  return change_to(next, what, command, [&] {
    if (command.kind == Command::Kind::load_scene) take_forks(simulation_, *next.committed);
    ChangeReport report =
        simulation::with_energy_report(simulation_, [&] { return std::swap(simulation_, *next.committed), what; });
    undo_ = Undo();
    restart_time();
    places_ = std::move(next.places);
    return report;
  });
}

ChangeReport SimulationRunner::change_to(NextScene& next, const std::string& what, const Command& command,
                                         const std::function<ChangeReport()>& perform) {
  const Lock lock(mutex_);
  const RecordedChange noted(*this, what, command);
  ChangeReport report = perform();
  if (!next.committed) return report;
  ahead_.change_scene(*next.shown);
  std::swap(scene_, next.scene);
  std::swap(task_, *next.task);
  return report;
}

void SimulationRunner::keep_journal(bool keep) {
  const Lock lock(mutex_);
  keeps_journal_ = keep;
  if (!keep) return filter_.record(nullptr);
  filter_.record([this](const hand_input::AcceptedInput& accepted) {
    journal_.note(accepted.committed, accepted.target, times_.stamp_of(accepted.t), accepted);
  });
  const RecordedChange noted(*this, "the journal begins", {});
}

void SimulationRunner::note_state() {
  const Lock lock(mutex_);
  if (keeps_journal_) journal_.note(filter_.committed(), filter_.target(), stamp(), comparison_of(simulation_));
}

std::optional<std::int64_t> SimulationRunner::stamp() const {
  return filter_.has_sample() ? std::make_optional(times_.stamp_of(simulation_.time())) : std::nullopt;
}

HandStatistics SimulationRunner::hand_statistics(std::size_t hand) const {
  const Lock lock(mutex_);
  const HandInput& input = inputs_.at(hand);
  return {input.monitor.figures(), filter_.gate_counts(hand), filter_.reacquisition_counts(hand),
          filter_.tracker_moves(hand), input.newest_arrival};
}

}  // namespace spring_workbench::live
