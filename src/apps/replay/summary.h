#pragma once

#include <set>
#include <string>
#include <utility>

#include "spring_workbench/hand_input/feed.h"
#include "spring_workbench/live/journal.h"

namespace spring_workbench::replay {

/// What a whole run did.
class Summary {
 public:
  std::size_t samples = 0;      ///< of all hands
  hand_input::GateCounts gate;  ///< of them
  hand_input::ReacquisitionCounts hand;
  simulation::AdvanceReport advance;
  int outputs = 0;                ///< output times
  double wall_time = 0.0;         ///< [s]
  live::ReplayedChanges changes;  ///< of a live run
  std::uint64_t state_hash = 0;   ///< of the simulation at the end

  void add(const hand_input::GateCounts& of_hand);
  void add(const hand_input::ReacquisitionCounts& of_hand);
  /// Counts the pairs in contact now that were not at the call before.
  void add_contacts(const std::vector<contact::ContactState>& contacts);
  /// One line of JSON, as `help_text()` describes it.
  std::string json() const;

 private:
  using Pair = std::pair<std::string, std::string>;

  int contacts_ = 0;
  std::set<Pair> touching_;
};

}  // namespace spring_workbench::replay
