#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench::services {

/// The services of the node `manipulation`, which end with what is returned. Each makes one change of the simulation;
/// what cannot be done is answered with `success = false` and one line, and changes nothing. `runner` must outlive
/// them; `scene_roots`: the folders that scenes may be loaded from, as of load_scene().
std::vector<ros::ServiceServer> advertise_services(ros::NodeHandle private_node, live::SimulationRunner& runner,
                                                   const std::vector<std::string>& scene_roots);

}  // namespace spring_workbench::services
