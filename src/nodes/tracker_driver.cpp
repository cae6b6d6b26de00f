#include "spring_workbench/ros/tracker_driver/tracker_driver.h"

#include <ros/ros.h>

#include <iostream>

#include "spring_workbench/config/command_line.h"
#include "spring_workbench/ros/common/background_log.h"
#include "spring_workbench/ros/common/exit_after_timeout.h"
#include "spring_workbench/validation/input_error.h"

/// Publishes the tracker as tf frames and buttons. Exit status 2: bad parameters or motion file.
int main(int argc, char** argv) {
  if (spring_workbench::config::print_node_help(argc, argv, "tracker_driver",
                                                "publishes the poses of the hands as tf frames, and their buttons."))
    return 0;
  ros::init(argc, argv, "tracker_driver", ros::init_options::NoRosout);
  spring_workbench::ros_common::exit_after_timeout(ros::isShuttingDown);
  try {
    const ros::NodeHandle node;  // starts roscpp
    spring_workbench::ros_common::log_in_background();
    spring_workbench::tracker_driver::run(node, ros::NodeHandle("~"));
  } catch (const spring_workbench::validation::InputError& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
