#include "spring_workbench/ros_interface/contact_sound.h"

#include <ros/ros.h>

#include <iostream>

#include "spring_workbench/config/input_error.h"

/// Contacts as sound. Exit status 2: bad parameters, or nowhere to play.
int main(int argc, char** argv) {
  ros::init(argc, argv, "contact_sound");
  try {
    const spring_workbench::ContactSound sound(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const spring_workbench::InputError& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
