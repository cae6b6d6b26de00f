#include "spring_workbench/ros_interface/parameters.h"

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/fork_mesh/fork_curve.h"

namespace spring_workbench {
namespace {

void take_number(YAML::Node& map, const std::string& where, const std::string& key, const NumberRule& rule,
                 double& value) {
  if (const YAML::Node node = take(map, key)) value = read_number(node, where, key, rule);
}

void take_frame(YAML::Node& map, const std::string& where, const std::string& key, std::string& value) {
  const YAML::Node node = take(map, key);
  if (!node) return;
  value = read_string(node, where, key);
  if (value.empty() || value.front() == '/')
    refuse(where, key, "\"" + value + "\"", "a frame name without a leading /");
}

}  // namespace

YAML::Node to_yaml(const XmlRpc::XmlRpcValue& value, const std::string& key) {
  XmlRpc::XmlRpcValue copy = value;  // its readers are not const
  YAML::Node node;
  switch (copy.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      node = static_cast<bool>(copy);
      break;
    case XmlRpc::XmlRpcValue::TypeInt:
      node = static_cast<int>(copy);
      break;
    case XmlRpc::XmlRpcValue::TypeDouble:
      node = static_cast<double>(copy);
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
      refuse("parameter server", key, "a date or binary value", "a bool, number, string, list or map");
  }
  return node;
}

YAML::Node private_parameters(const ros::NodeHandle& private_node) {
  XmlRpc::XmlRpcValue values;
  const std::string name = private_node.getNamespace();
  if (!private_node.getParam(name, values)) return YAML::Node(YAML::NodeType::Map);
  return to_yaml(values, name);
}

YAML::Node take(YAML::Node& map, const std::string& key) {
  const YAML::Node found = map[key];
  if (!found) return YAML::Node(YAML::NodeType::Undefined);
  map.remove(key);
  return found;
}

ManipulationParameters read_manipulation_parameters(const YAML::Node& parameters, const std::string& where) {
  if (!parameters.IsMap()) throw InputError(where + ": must be a map of parameters");
  YAML::Node rest(YAML::NodeType::Map);
  for (const auto& entry : parameters) rest[entry.first] = entry.second;
  ManipulationParameters result;
  const YAML::Node scene = take(rest, "scene");
  if (!scene) refuse(where, "scene", "(nothing)", "a URDF's path or package:// URI");
  result.scene = read_string(scene, where, "scene");
  if (const YAML::Node roots = take(rest, "scene_roots")) {
    if (!roots.IsSequence()) refuse(where, "scene_roots", YAML::Dump(roots), "a list of folders");
    for (const YAML::Node& root : roots) result.scene_roots.push_back(read_string(root, where, "scene_roots"));
  }
  take_number(rest, where, "rate", between(1.0, 2000.0), result.rate);
  take_number(rest, where, "markers_rate", between(0.1, 200.0), result.markers_rate);
  if (const YAML::Node curve = take(rest, "fork_curve")) {
    result.fork_curve = read_choice(curve, where, "fork_curve", fork_curve_names());
  }
  take_number(rest, where, "max_age", positive(), result.max_age);
  take_frame(rest, where, "world_frame", result.world_frame);
  take_frame(rest, where, "workbench_frame", result.workbench_frame);
  take_frame(rest, where, "stylus_frame", result.stylus_frame);
  take_truth_settings(rest, where, result.truth);
  take(rest, "resume");  // see Checkpoint
  take(rest, "live");    // what dynamic_reconfigure left there; the simulation starts from its own settings
  apply_settings(rest, where, result.simulation);
  return result;
}

}  // namespace spring_workbench
