#pragma once

#include <deque>
#include <map>
#include <string>
#include <utility>

#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// All objects where they are, at rest, at time `now` [s]; nothing is held and no sample is known. Where they are.
std::map<std::string, RigidTransform> put_to_rest(simulation::Simulation& simulation, double now);

/// The states before the last 20 changes, each to be taken back.
class Undo {
 public:
  /// `before`: the state before the change that is told as `what`.
  void keep(std::string what, simulation::SimulationState before);
  /// Takes the last one back: objects, tools and settings are as they were before it; objects are at rest and nothing
  /// is held, no sample is known, and time does not go back. Returns what it was. Throws InputError where there is
  /// none.
  std::string take_back(simulation::Simulation& simulation);

 private:
  std::deque<std::pair<std::string, simulation::SimulationState>> before_;
};

}  // namespace spring_workbench::live
