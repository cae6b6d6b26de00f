#pragma once

#include <ros/node_handle.h>

#include <memory>

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench::services {

/// Live tuning through dynamic_reconfigure, under `~live` (cfg/Manipulation.cfg): DOFs, stiffness, damping, integrator,
/// step. The simulation's values are authoritative: a new value is passed to the simulation and, if that refuses it,
/// reset with a warning; changes made by services show up here within 0.2 s.
class LiveTuning {
 public:
  virtual ~LiveTuning() = default;
};

/// Returns null if the package was built without dynamic_reconfigure. `runner` must outlive the result.
std::unique_ptr<LiveTuning> make_live_tuning(const ros::NodeHandle& private_node, live::SimulationRunner& runner);

}  // namespace spring_workbench::services
