#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "spring_workbench/ros/common/background_log.h"
#include "spring_workbench/ros/manipulation/manipulation_node.h"
#include "spring_workbench/validation/input_error.h"

namespace {

/// Which the line to the master may take at the end. Noticed by `master_test.py`.
constexpr std::chrono::milliseconds longest_end(1500);
std::atomic<bool> end_asked{false};

void ask_for_end(int) { end_asked = true; }

/// roscpp's own handlers close the connection to the master before the node has deleted its parameters there.
void end_in_order() {
  std::signal(SIGINT, ask_for_end);
  std::signal(SIGTERM, ask_for_end);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of the size of files is an error of what is written, not the node's end
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", [](XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result) {
    end_asked = true;
    result = ros::xmlrpc::responseInt(1, "", 0);
  });
}

}  // namespace

/// Tools, spring-fork dynamics and collision behind ROS topics and services. Exit status 2: bad parameters or scene.
int main(int argc, char** argv) {
  ros::init(argc, argv, "manipulation", ros::init_options::NoSigintHandler);
  spring_workbench::ros_common::log_in_background();
  end_in_order();
  std::thread([] {
    while (!end_asked) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::this_thread::sleep_for(longest_end);  // a master that is gone or hangs does not keep the node from its end
    if (spring_workbench::ros_common::error_output_takes_more()) {
      std::cerr << "shutdown has taken longer than 1.5 s, probably because the ROS master does not answer; exiting now"
                << std::endl;
    }
    std::_Exit(0);
  }).detach();
  try {
    const spring_workbench::manipulation::ManipulationNode node(ros::NodeHandle(), ros::NodeHandle("~"));
    while (ros::ok() && !end_asked) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  } catch (const spring_workbench::validation::InputError& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
