#include "spring_workbench/ros/common/parameters.h"

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::ros_common {
YAML::Node to_yaml(const XmlRpc::XmlRpcValue& value, const std::string& key) {
  XmlRpc::XmlRpcValue copy = value;  // XmlRpcValue's conversions are not const
  YAML::Node node;
  switch (copy.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      node = static_cast<bool>(copy);
      break;
    case XmlRpc::XmlRpcValue::TypeInt:
      node = static_cast<int>(copy);
      break;
    case XmlRpc::XmlRpcValue::TypeDouble:
      node = config::number_node(static_cast<double>(copy));
      break;
    case XmlRpc::XmlRpcValue::TypeString:
      node = static_cast<std::string>(copy);
      break;
    case XmlRpc::XmlRpcValue::TypeArray:
      node = YAML::Node(YAML::NodeType::Sequence);
      for (int i = 0; i < copy.size(); ++i) node.push_back(to_yaml(copy[i], key));
      break;
    case XmlRpc::XmlRpcValue::TypeStruct:
      node = YAML::Node(YAML::NodeType::Map);
      for (auto& entry : copy) node[entry.first] = to_yaml(entry.second, entry.first);
      break;
    default:
      validation::refuse("parameter server", key, "a bool, number, string, list or map, got a date or binary value");
  }
  return node;
}

YAML::Node private_parameters(const ros::NodeHandle& private_node) {
  XmlRpc::XmlRpcValue values;
  const std::string& name = private_node.getNamespace();
  if (!private_node.getParam(name, values)) return YAML::Node(YAML::NodeType::Map);
  return to_yaml(values, name);
}

YAML::Node take(YAML::Node& map, const std::string& key) {
  const YAML::Node found = map[key];
  if (!found) return YAML::Node(YAML::NodeType::Undefined);
  map.remove(key);
  return found;
}

}  // namespace spring_workbench::ros_common
