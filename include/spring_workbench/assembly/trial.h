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
  std::vector<motion::StylusSample> motion;  ///< of the hands, as they were sampled
  int steps_rejected = 0;
};

/// Returns what an operator perceives of the simulation: its objects and the tools of the hands.
OperatorView operator_view(const simulation::Simulation& simulation);

/// The settings with a stylus for each hand of the operator, or more.
simulation::SimulationSettings with_all_hands(const scene::Scene& scene, simulation::SimulationSettings settings);

/// Runs one: no clock, no ROS; the same arguments give bit-identical results. The simulation has all hands, and runs
/// one sample behind them, as it does live. Ends when the operator does, or after `time_limit` [s]. Throws InputError
/// as Simulation does.
Trial run_trial(const scene::Scene& scene, const simulation::SimulationSettings& simulation_settings,
                const OperatorSettings& operator_settings, double time_limit = 300.0);

}  // namespace spring_workbench::assembly
