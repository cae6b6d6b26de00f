#pragma once

#include <set>
#include <string>
#include <utility>

#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/tracker/reengagement.h"
#include "spring_workbench/tracker/sample_gate.h"

namespace spring_workbench::replay {

/// What a whole run did.
class Summary {
 public:
  int samples = 0;  ///< of all hands
  GateCounts gate;  ///< of them
  ReengagementCounts hand;
  int outputs = 0;         ///< output times
  double wall_time = 0.0;  ///< [s]

  void add(const AdvanceReport& report);
  void add(const GateCounts& of_hand);
  void add(const ReengagementCounts& of_hand);
  /// Counts the pairs in contact now that were not at the call before.
  void add_contacts(const std::vector<ContactState>& contacts);
  /// One line of JSON, as `help_text()` describes it.
  std::string json() const;

 private:
  using Pair = std::pair<std::string, std::string>;

  AdvanceReport total_;
  int contacts_ = 0;
  std::set<Pair> touching_;
  std::set<std::string> parts_run_, parts_left_out_;
};

}  // namespace spring_workbench::replay
