#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <atomic>
#include <csignal>
#include <iostream>

#include "spring_workbench/config/command_line.h"
#include "spring_workbench/ros/common/background_log.h"
#include "spring_workbench/ros/common/exit_after_timeout.h"
#include "spring_workbench/ros/manipulation/manipulation_node.h"
#include "spring_workbench/validation/input_error.h"

namespace {

std::atomic<bool> end_asked{false};

void ask_for_end(int) { end_asked = true; }

/// Installs signal handlers, because those of roscpp close the connection to the master before the node has deleted its
/// parameters there.
void end_in_order() {
  std::signal(SIGINT, ask_for_end);
  std::signal(SIGTERM, ask_for_end);
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding the file size limit is a write error and must not end the node
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", [](XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result) {
    end_asked = true;
    result = ros::xmlrpc::responseInt(1, "", 0);
  });
}

}  // namespace

/// Tools, spring-fork dynamics and collision behind ROS topics and services. Exit status 2: bad parameters or scene.
int main(int argc, char** argv) {
  if (spring_workbench::config::print_node_help(argc, argv, "manipulation",
                                                "simulates the held object, its tools and contact for all hands."))
    return 0;
  ros::init(argc, argv, "manipulation", ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  end_in_order();
  spring_workbench::ros_common::exit_after_timeout([] { return end_asked.load(); });
  try {
    const ros::NodeHandle handle;  // starts roscpp
    spring_workbench::ros_common::log_in_background();
    const spring_workbench::manipulation::ManipulationNode node(handle, ros::NodeHandle("~"));
    while (ros::ok() && !end_asked) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  } catch (const spring_workbench::validation::InputError& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
