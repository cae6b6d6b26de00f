#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "spring_workbench/hand_input/feed.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// The committed simulation was changed by other means than its hands: a service, a panel, another time or scene.
struct Change {
  std::string what;                   ///< in words, e.g. the service's name
  std::string scene;                  ///< path of the scene that the state is of
  std::uint64_t hash_before = 0;      ///< of the state before the change
  simulation::SimulationState state;  ///< after it; of no simulation where nothing was changed, but for the hash
};

/// One entry of a live run's journal. Entries are numbered without a gap.
struct Entry {
  std::uint64_t index = 0;
  double committed = 0.0;  ///< simulated time reached before it [s]; −infinity before the simulation began
  std::variant<hand_input::Accepted, Change> what;
};

/// Goes through a journal again: from the state of its first change on, each entry is given to a simulation of its own
/// once that has gone to the entry's time. So it does, bit by bit, what the committed simulation did.
class Replayer {
 public:
  using AtStop = std::function<void(simulation::Simulation&, const simulation::AdvanceReport&)>;

  /// `make_simulation(path)`: of the scene and the settings that the live run had.
  explicit Replayer(std::function<simulation::Simulation(const std::string&)> make_simulation)
      : make_simulation_(std::move(make_simulation)) {}

  /// Goes to the entry's time, stop by stop, each reported to `at_stop`; then does what the entry says. Entries before
  /// the first change are passed over. Throws InputError where an entry is missing before this one, and where the state
  /// before a change is not what it was.
  void play(const Entry& entry, const AtStop& at_stop);

  /// Null before the first change.
  const simulation::Simulation* simulation() const { return simulation_.empty() ? nullptr : &simulation_.front(); }
  std::size_t changes() const { return changes_; }

 private:
  void go_to(double t, const AtStop& at_stop);
  void apply(const hand_input::Accepted& accepted);
  void apply(const Change& change);

  std::function<simulation::Simulation(const std::string&)> make_simulation_;
  std::vector<simulation::Simulation> simulation_;  ///< none or one
  std::string scene_;
  std::uint64_t next_ = 0;
  std::size_t changes_ = 0;
};

}  // namespace spring_workbench::live
