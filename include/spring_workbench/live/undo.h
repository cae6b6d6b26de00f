#pragma once

#include <deque>
#include <map>
#include <string>
#include <utility>

#include "spring_workbench/live/command.h"

namespace spring_workbench::live {

/// All objects where they are, at rest, at time `now` [s]; nothing is held and no sample is known. Where they are.
std::map<std::string, RigidTransform> put_to_rest(simulation::Simulation& simulation, double now);

/// The states before the last 20 edits and resets, each to be taken back.
class Undo {
 public:
  /// Makes a change as live::perform() does. An edit and a reset are kept; Kind::undo takes the last one back: objects,
  /// tools and settings are as they were before it, objects are at rest and nothing is held, no sample is known, and
  /// time does not go back; the report's message tells what it was. Throws InputError where there is none.
  simulation::ChangeReport perform(const Command& command, simulation::Simulation& simulation);
  /// Whether nothing is kept.
  bool empty() const { return before_.empty(); }

 private:
  simulation::ChangeReport take_back(simulation::Simulation& simulation);

  std::deque<std::pair<std::string, simulation::SimulationState>> before_;
};

}  // namespace spring_workbench::live
