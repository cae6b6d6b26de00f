#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "spring_workbench/live/command.h"

namespace spring_workbench::live {

/// Resets the simulation to time `now` [s], with all objects at rest at their current poses. Returns these poses.
Places put_to_rest(simulation::Simulation& simulation, double now);

/// Undo history: the states before the last 20 edits and resets.
class Undo {
 public:
  /// First phase of perform(): returns the simulation in which it continues, if it needs another one. Slow, but another
  /// thread may advance `simulation` meanwhile (Simulation::prepare_edit). Throws what perform() throws.
  std::optional<simulation::Simulation> prepare(const Command& command, const simulation::Simulation& simulation) const;
  /// Makes a change like live::perform(), or an edit, and saves the state before an edit or a reset. Kind::undo goes
  /// back to the last one (Simulation::rewind_to); the report's message names the change that was undone. Throws
  /// InputError if there is nothing to undo. `next`: from prepare(); afterwards it is the simulation as it was before.
  ChangeReport perform(const Command& command, simulation::Simulation& simulation,
                       std::optional<simulation::Simulation>& next);
  ChangeReport perform(const Command& command, simulation::Simulation& simulation) {
    std::optional<simulation::Simulation> next = prepare(command, simulation);
    return perform(command, simulation, next);
  }
  /// Returns true if there is nothing to undo.
  bool empty() const { return before_.empty(); }

 private:
  using Before = std::pair<std::string, simulation::SimulationState>;
  const Before& last() const;
  std::string take_back(simulation::Simulation& simulation, std::optional<simulation::Simulation>& next);

  std::deque<Before> before_;
};

}  // namespace spring_workbench::live
