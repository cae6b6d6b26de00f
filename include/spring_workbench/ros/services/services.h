#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench::services {

/// Advertises the services of the node `manipulation`, until what is returned is destroyed. Each makes one change of
/// the simulation; a call that fails returns `success = false` and one line, and changes nothing. `runner` must outlive
/// them; `scene_roots`: the folders that scenes may be loaded from, as of load_scene().
std::vector<ros::ServiceServer> advertise_services(ros::NodeHandle private_node, live::SimulationRunner& runner,
                                                   const std::vector<std::string>& scene_roots);

}  // namespace spring_workbench::services
