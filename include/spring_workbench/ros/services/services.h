#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench::services {

/// Advertises the services of the node `manipulation` until the returned servers are destroyed. Each makes one change
/// of the simulation; a call that fails changes nothing and returns `success = false` with a one-line message. `runner`
/// must outlive the servers. `scene_roots`: folders that scenes may be loaded from, as in load_scene().
std::vector<ros::ServiceServer> advertise_services(ros::NodeHandle private_node, live::SimulationRunner& runner,
                                                   const std::vector<std::string>& scene_roots);

}  // namespace spring_workbench::services
