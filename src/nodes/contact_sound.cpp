#include "spring_workbench/ros/contact_sound/contact_sound.h"

#include <ros/ros.h>

#include <iostream>

#include "spring_workbench/config/command_line.h"
#include "spring_workbench/ros/common/exit_after_timeout.h"
#include "spring_workbench/validation/input_error.h"

/// Plays contacts as sound. Exit status 2: bad parameters, or no output for sound.
int main(int argc, char** argv) {
  if (spring_workbench::config::print_node_help(argc, argv, "contact_sound", "plays contacts as sound.")) return 0;
  ros::init(argc, argv, "contact_sound");
  spring_workbench::ros_common::exit_after_timeout(ros::isShuttingDown);
  try {
    spring_workbench::contact_sound::run(ros::NodeHandle(), ros::NodeHandle("~"));
  } catch (const spring_workbench::validation::InputError& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
