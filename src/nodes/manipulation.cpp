#include <ros/ros.h>

#include <iostream>

#include "spring_workbench/config/input_error.h"
#include "spring_workbench/ros_interface/manipulation_node.h"

/// Tools, spring-fork dynamics and collision behind ROS topics and services. Exit status 2: bad parameters or scene.
int main(int argc, char** argv) {
  ros::init(argc, argv, "manipulation");
  try {
    const spring_workbench::ManipulationNode node(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const spring_workbench::InputError& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
