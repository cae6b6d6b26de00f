#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench::manipulation {

/// What a node `manipulation` that is started again after a crash goes on with: the scene's path and the simulation's
/// state (simulation::serialise). It lies on the parameter server under `~resume`, is brought up to date twice a second
/// while something changes, and is deleted when the node ends in order.
class Checkpoint {
 public:
  /// Brings the runner to the checkpoint, where there is one of a node that was started with the same scene; one that
  /// cannot be used is told, and nothing of it is. `runner` must outlive this; `scene_roots`: as of load_scene().
  Checkpoint(const ros::NodeHandle& private_node, live::SimulationRunner& runner,
             const std::vector<std::string>& scene_roots);
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  /// To a master that was started anew: the node's parameters and the checkpoint, for the one that comes after this.
  void hand_over();

 private:
  void resume(const std::vector<std::string>& scene_roots);
  void keep();

  ros::NodeHandle private_node_;
  live::SimulationRunner& runner_;
  XmlRpc::XmlRpcValue parameters_;  ///< of the node, at its start
  std::string kept_scene_;          ///< path; empty: nothing is kept
  simulation::SimulationState kept_state_;
  bool handed_over_ = false;
  ros::SteadyTimer timer_;
};

}  // namespace spring_workbench::manipulation
