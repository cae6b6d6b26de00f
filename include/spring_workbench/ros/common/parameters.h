#pragma once

#include <XmlRpcValue.h>
#include <ros/node_handle.h>
#include <yaml-cpp/yaml.h>

#include <string>

namespace spring_workbench::ros_common {

/// Converts a value of the parameter server to YAML, so that the same readers serve files, command lines and
/// parameters. Throws InputError naming `key` for types without a YAML equivalent (dates, binary data).
YAML::Node to_yaml(const XmlRpc::XmlRpcValue& value, const std::string& key);

/// All private parameters of a node as one YAML map; empty if there are none.
YAML::Node private_parameters(const ros::NodeHandle& private_node);

/// Removes the entry `key` from the map and returns it; an undefined node if there is none.
YAML::Node take(YAML::Node& map, const std::string& key);

}  // namespace spring_workbench::ros_common
