#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include "spring_workbench/LoadScene.h"
#include "spring_workbench/SelectTool.h"
#include "spring_workbench/SetForkDamping.h"
#include "spring_workbench/SetForkDofs.h"
#include "spring_workbench/SetForkStiffness.h"
#include "spring_workbench/SetIntegrator.h"
#include "spring_workbench/ros/manipulation/simulation_runner.h"

namespace spring_workbench::manipulation {

/// The services of the node `manipulation`. Each makes one change of the simulation; what cannot be done is answered
/// with `success = false` and one line, and changes nothing.
class Services {
 public:
  /// `runner` must outlive this; `scene_roots`: the folders that scenes may be loaded from, as of load_scene().
  Services(ros::NodeHandle private_node, SimulationRunner& runner, std::vector<std::string> scene_roots);

 private:
  bool select_tool(SelectTool::Request& request, SelectTool::Response& response);
  bool set_dofs(SetForkDofs::Request& request, SetForkDofs::Response& response);
  bool set_stiffness(SetForkStiffness::Request& request, SetForkStiffness::Response& response);
  bool set_damping(SetForkDamping::Request& request, SetForkDamping::Response& response);
  bool set_integrator(SetIntegrator::Request& request, SetIntegrator::Response& response);
  bool load_scene(LoadScene::Request& request, LoadScene::Response& response);
  bool calibrate(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool release(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  template <typename Response>
  void change_fork(const simulation::ForkChange& change, std::optional<std::size_t> hand, Response& response);

  SimulationRunner& runner_;
  std::vector<std::string> scene_roots_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace spring_workbench::manipulation
