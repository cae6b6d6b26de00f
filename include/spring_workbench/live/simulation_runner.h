#pragma once

#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "spring_workbench/assembly/task_monitor.h"
#include "spring_workbench/live/command.h"
#include "spring_workbench/live/fair_mutex.h"
#include "spring_workbench/live/hand_times.h"
#include "spring_workbench/live/journal.h"
#include "spring_workbench/live/look_ahead.h"
#include "spring_workbench/live/pace.h"
#include "spring_workbench/live/stylus_events.h"
#include "spring_workbench/motion/pose_predictor.h"
#include "spring_workbench/motion/stream_monitor.h"

namespace spring_workbench::live {

/// What one cycle of the physics loop did.
struct CycleReport {
  simulation::AdvanceReport advance;
  double wall_time = 0.0;      ///< [s], by the steady clock
  bool behind = false;         ///< simulated time is slower than the hands': their samples are left out
  double left_out = 0.0;       ///< of time, which nobody simulates: a leap of the hands' time [s]
  bool more = false;           ///< there is more to commit at once: call `cycle` again
  PredictionError prediction;  ///< of what was shown for the time that is committed now
  double input_age = 0.0;      ///< of the newest sample, by its stamp [s]
  std::array<std::vector<RejectedPose>, simulation::Simulation::most_hands> rejected;  ///< by the gate, of each hand
};

/// What became of one hand's samples so far.
struct HandStatistics {
  motion::StreamFigures stream;  ///< of the samples used
  hand_input::GateCounts gate;
  hand_input::ReacquisitionCounts reacquisition;
  std::size_t tracker_moves = 0;  ///< see Feed
  double newest_arrival = 0.0;    ///< of a sample used, in local time [s]
};

/// What came of one hand, as SimulationRunner keeps it.
struct HandInput {
  HandInput(std::size_t number, double dropout_after) : hand(number), monitor(dropout_after) {}
  std::size_t hand;
  motion::StreamMonitor monitor;
  double newest_arrival = 0.0;         ///< see HandStatistics
  double newest_age = 0.0;             ///< when it came, by its stamp [s]
  std::deque<StylusEvent> waiting;     ///< not fed yet
  std::vector<RejectedPose> rejected;  ///< not reported yet
};

/// The committed simulation and its feed with the lock that keeps physics, services and publishers apart, the copy that
/// is shown, the journal, and the epochs of the hands' clocks: times count from the epoch of the stylus that came
/// first; another one joins it. Time in which no sample comes and none is waited for, since the process stood or the
/// hands' clock leapt by more than 5 s, is left out: everything stays where it is, and the hands are followed anew.
/// Likewise what comes while simulating cannot keep up: simulated time slows down then.
class SimulationRunner {
 public:
  /// `simulated_time`: a clock that is set back begins the scene again, as a bag that is played again does; else time
  /// only goes on. Throws
  /// InputError when scene and settings do not fit.
  SimulationRunner(const scene::Scene& scene, const simulation::SimulationSettings& settings,
                   const hand_input::InputSettings& input, bool simulated_time);

  /// Feeds the events, then commits up to the next sample or button edge, where all is known up to that at local time
  /// `now`. In simulated time what the samples before a new epoch decide is committed first, and the epoch waits.
  CycleReport cycle(const HandEvents& events, const hand_input::LocalTime& now);

  /// Brings what is shown to the newest sample or, with `latency` > 0 [s], so far beyond and as far as local time has
  /// gone on since that sample came. Returns how far that is beyond the newest sample [s].
  double show(double latency, const hand_input::LocalTime& now);
  /// What is shown: for the caller of show() alone.
  const simulation::Simulation& shown() const { return ahead_.shown(); }

  /// Objects back to their start, nothing held; goes on with the next sample.
  void restart();
  /// Another scene, with the settings as they are now. Throws InputError, and keeps the old one, when it does not fit.
  void load(const scene::Scene& scene);
  /// Another scene, with tools and settings as of a saved state and the objects where they are in it; nobody holds.
  /// They are there when the first hand comes, too, whose time begins anew. Throws InputError, and keeps all as it was,
  /// when the state does not fit the scene.
  void resume(const scene::Scene& scene, const simulation::SimulationState& state);

  /// Calls `use(const Simulation&)` with exclusive access to the simulation.
  template <typename Use>
  auto locked(Use&& use) const {
    const Lock lock(mutex_);
    return use(simulation_);
  }
  /// Makes a change of the present scene, which the journal calls `what`. Throws as perform().
  simulation::ChangeReport change(const std::string& what, const Command& command);
  /// Whether a hand has come since the start.
  bool has_sample() const {
    return locked([this](const auto&) { return feed_.has_sample(); });
  }
  /// Grows with all that changes the committed simulation.
  std::size_t revision() const {
    return locked([this](const auto&) { return revision_; });
  }
  /// Entries from now on go to the journal, the first of them the state as it is; or none do.
  void keep_journal(bool keep);
  /// Has the journal say what the state's hash is, for comparison.
  void note_state();
  /// The entries since the last call.
  std::vector<Entry> take_journal();
  /// The assembly so far.
  assembly::TaskMonitor task() const {
    return locked([this](const auto&) { return task_; });
  }
  /// Stamp of the committed time, or of what is shown [ns]; `now` before the first sample.
  std::int64_t stamp(std::int64_t now) const;
  std::int64_t shown_stamp(std::int64_t now) const;
  /// Of a simulated time [ns].
  std::int64_t stamp_of(double t) const;
  HandStatistics hand_statistics(std::size_t hand) const;
  /// See LookAhead.
  double prediction_error_99() const {
    return locked([this](const auto&) { return ahead_.position_error_99(); });
  }

 private:
  using Lock = std::lock_guard<FairMutex>;
  /// While it lives the simulation is changed; then the journal gets what it has become.
  class Noted {
   public:
    Noted(SimulationRunner& runner, std::string what, Command command);
    ~Noted();

   private:
    SimulationRunner& runner_;
    std::string what_;
    Command command_;
    std::uint64_t hash_before_ = 0;
    double committed_;
  };
  void apply(HandInput& input, const NewEpoch& epoch);
  void apply(HandInput& input, const StylusPose& pose);
  void apply(HandInput& input, const StylusButton& button);
  void apply(HandInput& input, const ButtonsKnown& known);
  bool joins(const HandInput& input, const NewEpoch& epoch) const;
  double time_of(const HandInput& input, double t);
  void feed(HandInput& input, const StylusEvent& event);
  void feed(const hand_input::LocalTime& now);
  void commit(double stop, CycleReport& report);
  void start_anew(const std::string& what, std::map<std::string, RigidTransform> places);
  void begin_with(const std::string& what, const Command& command, simulation::Simulation simulation, LookAhead ahead,
                  std::map<std::string, RigidTransform> places);
  void note(double committed, std::variant<hand_input::Accepted, Change> what);

  mutable FairMutex mutex_;
  simulation::Simulation simulation_;
  hand_input::Feed feed_;
  LookAhead ahead_;
  assembly::TaskMonitor task_;
  std::vector<HandInput> inputs_;
  bool simulated_time_;
  Pace pace_;
  bool was_behind_ = false;  ///< and no sample has come since
  HandTimes times_;
  std::map<std::string, RigidTransform> places_;  ///< of objects, for the first epoch
  std::size_t revision_ = 0;
  bool keeps_journal_ = false;
  std::uint64_t next_entry_ = 0;
  std::vector<Entry> journal_;
};

}  // namespace spring_workbench::live
