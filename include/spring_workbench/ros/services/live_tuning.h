#pragma once

#include <ros/node_handle.h>

#include <memory>

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench::services {

/// Live tuning through dynamic_reconfigure, under `~live` (cfg/Manipulation.cfg): DOFs, stiffness, damping,
/// integrator, step. The simulation's values are the truth: what is set goes to the simulation, what it refuses is put
/// back with a warning, and what services change shows here within a fifth of a second.
class LiveTuning {
 public:
  virtual ~LiveTuning() = default;
};

/// Null where the package was built without dynamic_reconfigure. `runner` must outlive the result.
std::unique_ptr<LiveTuning> make_live_tuning(const ros::NodeHandle& private_node, live::SimulationRunner& runner);

}  // namespace spring_workbench::services
