#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "spring_workbench/assembly/task_monitor.h"
#include "spring_workbench/live/command.h"
#include "spring_workbench/live/fair_mutex.h"
#include "spring_workbench/live/hand_times.h"
#include "spring_workbench/live/journal.h"
#include "spring_workbench/live/look_ahead.h"
#include "spring_workbench/live/pace.h"
#include "spring_workbench/live/stylus_events.h"
#include "spring_workbench/live/undo.h"
#include "spring_workbench/live/view.h"
#include "spring_workbench/motion/pose_predictor.h"
#include "spring_workbench/motion/stream_monitor.h"

namespace spring_workbench::live {

/// Progress of the committed simulation.
struct Progress {
  bool has_sample = false;      ///< a sample has arrived since the start
  bool began = false;           ///< the simulation has reached the first sample
  std::int64_t stamp = 0;       ///< stamp of the simulated time reached [ns]; meaningless before `began`
  std::size_t revision = 0;     ///< increases with every change of the committed simulation
  bool is_interrupted = false;  ///< on its way to a sample or button edge: the steps to it take several cycles
};

/// A simulation at one moment.
struct Snapshot {
  Progress at;
  View view;
};

/// What was simulated, and at what cost.
struct Work {
  simulation::AdvanceReport advance;
  double wall_time = 0.0;      ///< [s], by the steady clock
  PredictionError prediction;  ///< error of the display for the time that is now committed
  void add(const Work& later);
};

/// The committed simulation and the state of the task at that moment.
struct Committed : Snapshot {
  std::vector<assembly::Placement> placements;
  assembly::TaskScore score;
  Work work;  ///< of the cycles that took the steps to this sample or button edge
};

/// The displayed simulation; the stamp is that of the displayed time.
struct Shown : Snapshot {
  double horizon = 0.0;  ///< time beyond the newest sample [s]
};

/// Decides whether a snapshot of this moment is needed.
using Wanted = std::function<bool(const Progress&)>;

/// Report of one cycle of the physics loop.
struct CycleReport : Work {
  bool behind = false;                              ///< the simulation is slower than the hands: samples are dropped
  double time_skipped = 0.0;                        ///< time skipped because the hands' clock jumped [s]
  bool more = false;                                ///< more can be committed at once: call `cycle` again
  double input_age = 0.0;                           ///< age of the newest sample by its stamp [s]
  std::vector<std::vector<RejectedPose>> rejected;  ///< poses of each hand that the gate rejected
};

/// Statistics of one hand's samples so far.
struct HandStatistics {
  motion::StreamFigures stream;  ///< figures of the samples used
  hand_input::GateCounts gate;
  hand_input::ReacquisitionCounts reacquisition;
  std::size_t tracker_moves = 0;  ///< see InputFilter
  double newest_arrival = 0.0;    ///< arrival of the newest sample used, in local time [s]
};

/// Input of one hand that SimulationRunner keeps.
struct HandInput {
  HandInput(std::size_t number, double dropout_after) : hand(number), monitor(dropout_after) {}
  /// Adds to the report the poses rejected since the last call, the age of the newest sample, and whether events are
  /// pending.
  void add_to(CycleReport& report);
  /// Records that a pose was used, at `t` [s].
  void used(double t, const StylusPose& pose);

  std::size_t hand;
  motion::StreamMonitor monitor;
  double newest_arrival = 0.0;         ///< see HandStatistics
  double newest_age = 0.0;             ///< age of the newest sample on arrival, by its stamp [s]
  std::deque<StylusEvent> waiting;     ///< not fed yet
  std::vector<RejectedPose> rejected;  ///< not reported yet
};

/// The scene that a change leads to: the committed and the displayed simulation of it, which are made without the lock
/// of the runner, because that may take long. After the change this is what was before, and is destroyed without the
/// lock.
struct NextScene {
  using Make = std::function<std::optional<simulation::Simulation>()>;
  /// `changing`: held as long as this exists, so that there is one change at a time. `make`: makes one of the two
  /// simulations, or nothing if the scene stays.
  NextScene(std::mutex& changing, const Make& make);

  std::lock_guard<std::mutex> one_at_a_time;
  std::optional<simulation::Simulation> committed, shown;
  std::shared_ptr<const scene::Scene> scene;
  std::optional<assembly::TaskMonitor> task;
  Places places;  ///< poses that the objects keep in the first epoch
};

/// Runs a live simulation. It owns the committed simulation and its input filter, the lock that physics, services and
/// publishers share, the displayed copy, the journal, and the epochs of the hands' clocks (times count from the epoch
/// of the first stylus; other styluses join it). Time is skipped if no sample arrives because the process was stopped,
/// or if the hands' clock jumps by more than 5 s: everything stays in place, and the hands are re-acquired. If the
/// simulation cannot keep up, samples are dropped and simulated time slows down.
class SimulationRunner {
 public:
  /// `simulated_time`: whether the clock is a simulated one. If so, a clock that is set back restarts the scene, as a
  /// bag that is played again does; on the wall clock, time never goes back. `pace`: measures how long commits take.
  /// Throws InputError if scene and settings do not match.
  SimulationRunner(const scene::Scene& scene, const simulation::SimulationSettings& settings,
                   const hand_input::InputSettings& input, bool simulated_time, Pace pace = Pace());

  /// Feeds the events and then commits up to the next sample or button edge, if at local time `now` the input is
  /// complete up to there. Where these steps take long (Pace::end_of_cycle), the next cycles continue them; the steps
  /// are the same. In simulated time, all that the samples before a new epoch determine is committed before it begins.
  CycleReport cycle(const HandEvents& events, const hand_input::LocalTime& now);

  /// Advances the displayed copy to the newest sample; with `latency` > 0 [s], further by `latency` and by the local
  /// time since that sample arrived. Returns a snapshot of the display, if it is wanted.
  std::optional<Shown> show(double latency, const hand_input::LocalTime& now, const Wanted& wanted);
  /// Returns a snapshot of the committed simulation, if it is wanted.
  std::optional<Committed> committed(const Wanted& wanted) const;

  /// Puts all objects back to their initial poses with nothing held; the simulation continues with the next sample.
  ChangeReport restart() { return change("reset", Command(Command::Kind::reset)); }
  /// Undoes the last edit or restart (class Undo). The task restarts, as after an edit.
  ChangeReport undo() { return change("undo", Command(Command::Kind::undo)); }
  /// Loads another scene with the current settings. Throws InputError, and keeps the old scene, if they do not match.
  ChangeReport load(const scene::Scene& scene);
  /// Loads a scene with the tools, settings and poses of a saved state; nothing is held. The objects keep these poses
  /// when the first hand arrives and time restarts. Throws InputError, and changes nothing, if they do not match.
  void resume(const scene::Scene& scene, const simulation::SimulationState& state);

  std::size_t hands() const { return inputs_.size(); }  ///< number of hands
  /// Calls `use(const Simulation&)` with exclusive access to the simulation.
  template <typename Use>
  auto locked(Use&& use) const {
    const Lock lock(mutex_);
    return use(simulation_);
  }
  /// The current scene with all edits.
  std::shared_ptr<const scene::Scene> scene() const {
    return locked([this](const auto&) { return scene_; });
  }
  /// Makes a change of the current scene, which the journal calls `what`. Throws as perform().
  ChangeReport change(const std::string& what, const Command& command);
  /// Measures a step of the largest length from the current state, which does not change; see LookAhead.
  StepTime time_of_step() {
    const Lock lock(mutex_);
    return ahead_.time_of_step(simulation_, filter_, pace_);
  }
  /// Starts the journal, with the current state as its first entry, or stops it.
  void keep_journal(bool keep);
  /// Records the hash of the current state in the journal, for comparison.
  void note_state();
  /// Returns the entries since the last call.
  std::vector<Entry> take_journal() {
    const Lock lock(mutex_);
    return journal_.take();
  }
  HandStatistics hand_statistics(std::size_t hand) const;
  double prediction_error_99() const {  ///< see LookAhead
    return locked([this](const auto&) { return ahead_.position_error_99(); });
  }

 private:
  using Lock = std::lock_guard<FairMutex>;
  class RecordedChange;
  void apply(HandInput& input, const NewEpoch& epoch);
  void apply(HandInput& input, const StylusPose& pose);
  void apply(HandInput& input, const StylusButton& button);
  void apply(HandInput& input, const ButtonsKnown& known);
  void apply(HandInput& input, const StylusWrench& wrench) { push(input, wrench, times_.time_of_stamp(wrench.stamp)); }
  void push(HandInput& input, StylusWrench wrench, double t);
  Progress progress_at(double t, bool began) const {
    return {filter_.has_sample(), began, times_.stamp_of(t), revision_, filter_.is_interrupted()};
  }
  bool joins(const HandInput& input, const NewEpoch& epoch) const;
  double time_of(const HandInput& input, double t);
  void feed(HandInput& input, const StylusEvent& event);
  void feed(const hand_input::LocalTime& now);
  std::optional<std::int64_t> stamp() const;
  void restart_time();
  /// Makes a change by `perform`, and continues in the next scene, if there is one.
  ChangeReport change_to(NextScene& next, const std::string& what, const Command& command,
                         const std::function<ChangeReport()>& perform);
  ChangeReport begin_with(NextScene& next, const std::string& what, const Command& command);
  simulation::SimulationSettings settings() const {
    return locked([](const auto& now) { return now.settings(); });
  }

  std::mutex changing_;  ///< see NextScene; never locked while mutex_ is held
  mutable FairMutex mutex_;
  simulation::Simulation simulation_;
  hand_input::InputFilter filter_;
  LookAhead ahead_;
  std::shared_ptr<const scene::Scene> scene_;
  mutable SharedStates objects_, shown_objects_;  ///< states in the last views
  assembly::TaskMonitor task_;
  std::vector<HandInput> inputs_;
  bool simulated_time_;
  Pace pace_;
  bool was_behind_ = false;  ///< was behind at the last cycle, and no sample has arrived since
  HandTimes times_;
  Places places_;  ///< poses of objects, for the first epoch
  Undo undo_;
  std::size_t revision_ = 0;
  Work work_;  ///< see Committed
  bool keeps_journal_ = false;
  Journal journal_;
};

}  // namespace spring_workbench::live
