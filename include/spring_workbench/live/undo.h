#pragma once

#include <deque>
#include <map>
#include <string>
#include <utility>

#include "spring_workbench/live/command.h"

namespace spring_workbench::live {

/// Resets the simulation to time `now` [s], with all objects at rest at their current poses. Returns these poses.
Places put_to_rest(simulation::Simulation& simulation, double now);

/// Undo history: the states before the last 20 edits and resets.
class Undo {
 public:
  /// Makes a change like live::perform(), and saves the state before an edit or a reset. Kind::undo goes back to
  /// the last one (Simulation::go_back_to); the report's message names the change that was undone. Throws InputError if
  /// there is nothing to undo.
  ChangeReport perform(const Command& command, simulation::Simulation& simulation);
  /// Returns true if there is nothing to undo.
  bool empty() const { return before_.empty(); }

 private:
  std::string take_back(simulation::Simulation& simulation);

  std::deque<std::pair<std::string, simulation::SimulationState>> before_;
};

}  // namespace spring_workbench::live
