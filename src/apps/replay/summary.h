#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/live/journal.h"

namespace spring_workbench::replay {

/// Summary of a run.
class Summary {
 public:
  std::size_t samples = 0;      ///< number of samples of all hands
  hand_input::GateCounts gate;  ///< gate results of these samples
  hand_input::ReacquisitionCounts hand;
  simulation::AdvanceReport advance;
  int outputs = 0;                ///< output times
  double wall_time = 0.0;         ///< [s]
  live::ReplayedChanges changes;  ///< changes of a replayed live run
  std::uint64_t state_hash = 0;   ///< hash of the simulation's state at the end

  void add(const hand_input::GateCounts& of_hand);
  void add(const hand_input::ReacquisitionCounts& of_hand);
  /// Counts the pairs in contact that were not in contact at the previous call; notes whether an object is held
  /// or probed.
  void add_state(const simulation::Simulation& simulation);
  /// What most likely is not what the user wanted, a line each: most samples rejected, steps that the integrator did
  /// not take, nothing held.
  std::vector<std::string> warnings() const;
  /// One line of JSON, as described by `help_text()`.
  std::string json() const;

 private:
  using Pair = std::pair<std::string, std::string>;

  std::size_t samples_rejected() const;

  int contacts_ = 0;
  bool held_ = false;  ///< whether an object was held or probed at an output time
  std::set<Pair> touching_;
};

}  // namespace spring_workbench::replay
