#pragma once

#include <memory>

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench {

/// A view of the current state of a simulation.
inline live::View view_of(const simulation::Simulation& simulation) {
  live::SharedStates objects;
  return live::view_of(simulation, std::make_shared<const scene::Scene>(simulation.scene()), objects);
}

/// Wants a snapshot of every moment.
inline bool always(const live::Progress&) { return true; }

}  // namespace spring_workbench
