#pragma once

#include <set>
#include <string>
#include <utility>

#include "spring_workbench/hand_input/feed.h"
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
  /// Counts the pairs in contact that were not in contact at the previous call.
  void add_contacts(const std::vector<contact::ContactState>& contacts);
  /// One line of JSON, as described by `help_text()`.
  std::string json() const;

 private:
  using Pair = std::pair<std::string, std::string>;

  int contacts_ = 0;
  std::set<Pair> touching_;
};

}  // namespace spring_workbench::replay
