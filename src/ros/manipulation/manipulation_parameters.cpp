#include "spring_workbench/ros/manipulation/manipulation_parameters.h"

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/fork_mesh/fork_curve.h"
#include "spring_workbench/motion/pose_predictor.h"
#include "spring_workbench/ros/common/parameters.h"

namespace spring_workbench::manipulation {
namespace {

void take_number(YAML::Node& map, const std::string& where, const std::string& key, const validation::NumberRule& rule,
                 double& value) {
  if (const YAML::Node node = ros_common::take(map, key)) value = config::read_number(node, where, key, rule);
}

void take_frame(YAML::Node& map, const std::string& where, const std::string& key, std::string& value) {
  const bool may_be_empty = value.empty();
  const YAML::Node node = ros_common::take(map, key);
  if (!node) return;
  value = config::read_string(node, where, key);
  if (value.empty() ? !may_be_empty : value.front() == '/')
    validation::refuse(where, key, value, "a frame name without a leading /");
}

}  // namespace

ManipulationParameters read_manipulation_parameters(const YAML::Node& parameters, const std::string& where) {
  if (!parameters.IsMap()) validation::refuse("", where, "a map of parameters");
  YAML::Node rest(YAML::NodeType::Map);
  for (const auto& entry : parameters) rest[entry.first] = entry.second;
  ManipulationParameters result;
  const YAML::Node scene = ros_common::take(rest, "scene");
  if (!scene) validation::refuse_missing(where, "scene", "path or package:// URI of a URDF");
  result.scene = config::read_string(scene, where, "scene");
  if (const YAML::Node roots = ros_common::take(rest, "scene_roots")) {
    if (!roots.IsSequence()) validation::refuse(where, "scene_roots", YAML::Dump(roots), "a list of folders");
    for (const YAML::Node& root : roots) result.scene_roots.push_back(config::read_string(root, where, "scene_roots"));
  }
  if (const YAML::Node file = ros_common::take(rest, "checkpoint_file"))
    result.checkpoint_file = config::read_string(file, where, "checkpoint_file");
  take_number(rest, where, "rate", validation::between(1.0, 2000.0).in("Hz"), result.rate);
  if (const YAML::Node priority = ros_common::take(rest, "realtime_priority"))
    result.realtime_priority = config::read_integer(priority, where, "realtime_priority", 0, 99);
  take_number(rest, where, "display_latency", validation::between(0.0, motion::PosePredictor::farthest).in("s"),
              result.display_latency);
  take_number(rest, where, "markers_rate", validation::between(0.1, 200.0).in("Hz"), result.markers_rate);
  if (const YAML::Node curve = ros_common::take(rest, "fork_curve")) {
    result.fork_curve = config::read_choice(curve, where, "fork_curve", fork_mesh::fork_curve_names());
  }
  take_number(rest, where, "fork_diameter", validation::between(0.01, 0.5), result.fork_diameter);
  take_number(rest, where, "max_age", validation::positive().in("s"), result.max_age);
  take_frame(rest, where, "world_frame", result.world_frame);
  take_frame(rest, where, "frame_prefix", result.frame_prefix);
  take_frame(rest, where, "workbench_frame", result.workbench_frame);
  take_frame(rest, where, "stylus_frame", result.stylus_frame);
  hand_input::take_input_settings(rest, where, result.input);
  ros_common::take(rest, "resume");  // see Checkpoint
  ros_common::take(rest, "live");    // left there by dynamic_reconfigure; the simulation starts from its own settings
  simulation::apply_settings(rest, where, result.simulation);
  return result;
}

}  // namespace spring_workbench::manipulation
