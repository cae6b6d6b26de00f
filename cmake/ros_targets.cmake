# The ROS side of the package: ros_interface and the nodes.
