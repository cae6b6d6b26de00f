# catkin: dependencies, messages and services of the package.
find_package(catkin REQUIRED COMPONENTS
  roscpp rosbag tf2 tf2_ros tf2_msgs diagnostic_msgs geometry_msgs message_generation sensor_msgs std_msgs std_srvs
  visualization_msgs)
