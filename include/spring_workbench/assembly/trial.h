#pragma once

#include <vector>

#include "spring_workbench/assembly/simulated_operator.h"
#include "spring_workbench/assembly/task_monitor.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::assembly {

/// One assembly by the simulated operator.
struct Trial {
  TaskScore score;
  std::vector<Placement> placements;
  std::vector<motion::StylusSample> motion;  ///< samples of all hands
  int steps_rejected = 0;
};

/// Returns the operator's view of the simulation: its objects and the tools in the hands.
OperatorView operator_view(const simulation::Simulation& simulation);

/// The settings with at least one stylus for each hand of the operator.
simulation::SimulationSettings with_all_hands(const scene::Scene& scene, simulation::SimulationSettings settings);

/// Runs one trial without clock or ROS; the same arguments give bit-identical results. The simulation stays one sample
/// behind the hands, as in a live session. Ends when the operator finishes or after `time_limit` [s] of simulated time.
/// Throws InputError as Simulation does.
Trial run_trial(const scene::Scene& scene, const simulation::SimulationSettings& simulation_settings,
                const OperatorSettings& operator_settings, double time_limit = 300.0);

}  // namespace spring_workbench::assembly
