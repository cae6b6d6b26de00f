#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/live/undo.h"

namespace spring_workbench::live {

/// A change of the committed simulation that does not come from a hand: a service call, a panel, a time jump or a new
/// scene.
struct Change {
  std::string what;               ///< name of the change, e.g. the service
  Command command;                ///< the change as a command, to be repeated in a replay
  std::string scene;              ///< path of the scene that the state belongs to
  std::uint64_t hash_before = 0;  ///< hash of the state before the change
  simulation::SimulationState
      state;  ///< state after the change; empty if nothing changed and only the hash is recorded
};

/// Returns an entry that changes nothing and only records the hash of the current state.
Change comparison_of(const simulation::Simulation& simulation);

/// Entry of the journal of a live run. Entries are numbered without a gap.
struct Entry {
  std::uint64_t index = 0;
  double committed = 0.0;  ///< simulated time reached before it [s]; −infinity before the simulation began
  double target = 0.0;     ///< later than `committed` if it interrupted an advance to this time [s]
  std::optional<std::int64_t>
      stamp;  ///< stamp of its time, by the clock at that moment [ns]; none before the first sample
  std::variant<hand_input::AcceptedInput, Change> what;
};

/// Divides the entries of a recording, each topic in the order of arrival, among the processes that published them, one
/// after the other: `manipulation` may have been killed and started again. Each counts from 0, so a new life begins
/// where the index of a topic goes back.
std::vector<std::vector<Entry>> lives_of(std::vector<Entry> entries);

/// Sorts the entries of one life by their index. Removes those before its first input if some are missing between them:
/// inputs and changes are published on two topics, and a recorder may be connected to the changes first. Once it is
/// connected to both, `manipulation` notes the whole state, from which the rest can be repeated.
std::vector<Entry> from_first_complete(std::vector<Entry> entries);

/// Counts of the changes of a journal after the first one.
struct ReplayedChanges {
  std::size_t repeated = 0;             ///< changes that were repeated
  std::size_t restored = 0;             ///< changes that cannot be repeated: the recorded state is restored
  std::vector<std::string> mismatches;  ///< changes that did not lead to the recorded state when they were repeated
};

/// Numbers entries and stores them until they are taken.
class Journal {
 public:
  void note(double committed, double target, std::optional<std::int64_t> stamp,
            std::variant<hand_input::AcceptedInput, Change> what) {
    entries_.push_back({next_++, committed, target, stamp, std::move(what)});
  }
  /// Returns the entries since the last call.
  std::vector<Entry> take() { return std::exchange(entries_, {}); }

 private:
  std::uint64_t next_ = 0;
  std::vector<Entry> entries_;
};

/// Replays a journal with a simulation of its own: starts from the state of the first change, advances to the time of
/// each entry, applies its input or repeats its change. The simulation is then bit-identical to the committed one.
class Replayer {
 public:
  using AtStop = std::function<void(simulation::Simulation&, const simulation::AdvanceReport&)>;

  /// `load_scene(path)` loads a scene; `settings`: those of the live run at its start, except for the number of
  /// styluses, which is taken from the journal.
  Replayer(std::function<scene::Scene(const std::string&)> load_scene, simulation::SimulationSettings settings)
      : load_scene_(std::move(load_scene)), settings_(std::move(settings)) {}

  /// Advances to the time of the entry, calling `at_stop` after each stop, and then applies the entry; after a change,
  /// `at_stop` is called once more with an empty report. Entries before the first change are ignored. If a change leads
  /// to another state than the recorded one, it counts as a mismatch, and the recorded state is used. Throws InputError
  /// if an entry before this one is missing, or if the state before a change differs from the recorded one.
  void play(const Entry& entry, const AtStop& at_stop);

  /// The simulation; null before the first change.
  const simulation::Simulation* simulation() const { return simulation_.empty() ? nullptr : &simulation_.front(); }
  const ReplayedChanges& changes() const { return changes_; }

 private:
  void advance_to_entry(const Entry& entry, const AtStop& at_stop);
  void apply(const hand_input::AcceptedInput& accepted);
  void apply(const Change& change);
  bool repeat(const Change& change);

  std::function<scene::Scene(const std::string&)> load_scene_;
  simulation::SimulationSettings settings_;
  std::vector<simulation::Simulation> simulation_;  ///< none or one
  std::string scene_;
  Undo undo_;
  std::uint64_t next_ = 0;
  ReplayedChanges changes_;
};

}  // namespace spring_workbench::live
