#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "spring_workbench/hand_input/feed.h"
#include "spring_workbench/live/command.h"

namespace spring_workbench::live {

/// The committed simulation was changed by other means than its hands: a service, a panel, another time or scene.
struct Change {
  std::string what;                   ///< in words, e.g. the service's name
  Command command;                    ///< the same, to be made again
  std::string scene;                  ///< path of the scene that the state is of
  std::uint64_t hash_before = 0;      ///< of the state before the change
  simulation::SimulationState state;  ///< after it; of no simulation where nothing was changed, but for the hash
};

/// No change: only the hash of the state as it is.
Change comparison_of(const simulation::Simulation& simulation);

/// One entry of a live run's journal. Entries are numbered without a gap.
struct Entry {
  std::uint64_t index = 0;
  double committed = 0.0;  ///< simulated time reached before it [s]; −infinity before the simulation began
  std::variant<hand_input::Accepted, Change> what;
};

/// What became of the changes of a journal after the first.
struct ReplayedChanges {
  std::size_t made_again = 0;
  std::size_t given = 0;                ///< of which only the state after them is known
  std::vector<std::string> mismatches;  ///< made again, they led to another state than the recorded one
};

/// Goes through a journal again: from the state of its first change on, each entry is given to a simulation of its own
/// once that has gone to the entry's time, and each change is made again. So it does, bit by bit, what the committed
/// simulation did.
class Replayer {
 public:
  using AtStop = std::function<void(simulation::Simulation&, const simulation::AdvanceReport&)>;

  /// `load_scene(path)`; `settings`: those that the live run began with.
  Replayer(std::function<scene::Scene(const std::string&)> load_scene, simulation::SimulationSettings settings)
      : load_scene_(std::move(load_scene)), settings_(std::move(settings)) {}

  /// Goes to the entry's time, stop by stop, each reported to `at_stop`; then does what the entry says, after a change
  /// with another report of no time. Entries before the first change are passed over. A change that leads to another
  /// state than the recorded one is a mismatch, and the recorded one is gone on with. Throws InputError where an entry
  /// is missing before this one, and where the state before a change is not what it was.
  void play(const Entry& entry, const AtStop& at_stop);

  /// Null before the first change.
  const simulation::Simulation* simulation() const { return simulation_.empty() ? nullptr : &simulation_.front(); }
  const ReplayedChanges& changes() const { return changes_; }

 private:
  void go_to(double t, const AtStop& at_stop);
  void apply(const hand_input::Accepted& accepted);
  void apply(const Change& change);
  void make_again(const Change& change);

  std::function<scene::Scene(const std::string&)> load_scene_;
  simulation::SimulationSettings settings_;
  std::vector<simulation::Simulation> simulation_;  ///< none or one
  std::string scene_;
  std::uint64_t next_ = 0;
  ReplayedChanges changes_;
};

}  // namespace spring_workbench::live
