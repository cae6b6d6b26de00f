#pragma once

#include <vector>

#include "spring_workbench/assembly/simulated_operator.h"
#include "spring_workbench/assembly/task_monitor.h"

namespace spring_workbench::assembly {

/// One assembly by the simulated operator.
struct Trial {
  TaskScore score;
  std::vector<Placement> placements;
  std::vector<motion::StylusSample> motion;  ///< of the hand, as it was sampled
  int steps_rejected = 0;
};

/// What an operator sees who looks at the simulation and has its first hand's tool.
OperatorView look_at(const simulation::Simulation& simulation);

/// Runs one: no clock, no ROS; the same arguments give bit-identical results. The simulation runs one sample behind the
/// hand, as it does live. Ends when the operator does, or after `time_limit` [s]. Throws InputError as Simulation does.
Trial run_trial(const scene::Scene& scene, const simulation::SimulationSettings& simulation_settings,
                const OperatorSettings& operator_settings, double time_limit = 300.0);

}  // namespace spring_workbench::assembly
