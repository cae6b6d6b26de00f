#pragma once

#include <XmlRpcValue.h>
#include <ros/node_handle.h>
#include <yaml-cpp/yaml.h>

#include <string>

namespace spring_workbench::ros_common {

/// A value of the parameter server as YAML: the same readers serve files, command lines and parameters.
/// Throws InputError for what YAML has no word for (dates, binary data), naming `key`.
YAML::Node to_yaml(const XmlRpc::XmlRpcValue& value, const std::string& key);

/// All private parameters of a node as one YAML map; empty where there are none.
YAML::Node private_parameters(const ros::NodeHandle& private_node);

/// Takes the entry `key` out of the map; an undefined node where there is none.
YAML::Node take(YAML::Node& map, const std::string& key);

}  // namespace spring_workbench::ros_common
