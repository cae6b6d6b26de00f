#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <set>
#include <string>
#include <utility>

#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench {

/// Draws the simulation for rviz: bodies, targets, the deformed fork, contact points with their normals, and the force
/// at the tip (half the fork's length for the held object's weight). Every marker keeps its namespace and id while what
/// it shows is there and is deleted by name when it is gone, so that nothing flickers.
class MarkerBuilder {
 public:
  visualization_msgs::MarkerArray build(const Simulation& simulation, const std_msgs::Header& header);

 private:
  using MarkerKey = std::pair<std::string, int>;

  void delete_what_is_gone(const std_msgs::Header& header, visualization_msgs::MarkerArray& markers);

  std::set<MarkerKey> shown_;
};

}  // namespace spring_workbench
