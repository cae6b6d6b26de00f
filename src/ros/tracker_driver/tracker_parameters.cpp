#include "spring_workbench/ros/tracker_driver/tracker_parameters.h"

#include <algorithm>
#include <vector>

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::tracker_driver {
namespace {

/// The parameters that belong to a source.
std::vector<std::string> keys_of(const std::string& source) {
  std::vector<std::string> keys{"source",     "rate", "workbench_frame",         "stylus_frame",
                                "head_frame", "head", "interpupillary_distance", "dropout_after"};
  const auto add = [&](const std::vector<std::string>& more) { keys.insert(keys.end(), more.begin(), more.end()); };
  if (source == "fastrak") {
    add({"offset", "tip", "even_stamps", "latency", "head_stations"});
    add(fastrak::fastrak_keys());
  } else if (source == "mouse" || source == "joy") {
    add({"start"});
    if (source == "joy") add(joy_keys());
  } else if (source == "operator") {
    add({"offset", "tip", "scene", "seed", "speed", "loop", "pause"});
  } else {
    add({"offset", "tip", "file", "speed", "loop", "pause", "start", "grasp_from", "grasp_until"});
  }
  return keys;
}

/// Reads the source by the values of the launch argument `input`; also accepts the former name of `mouse`.
std::string read_source(const YAML::Node& value, const std::string& where) {
  if (value.IsScalar() && value.Scalar() == "interactive_marker") return "mouse";
  return config::read_choice(value, where, "source",
                             {"mouse", "joy", "fastrak", "operator", "scripted", "motion_file"});
}

std::vector<int> read_head_stations(const YAML::Node& value, const std::string& where,
                                    const std::vector<int>& stations) {
  std::vector<int> heads;
  for (const YAML::Node& entry : value) {
    const int station = config::read_integer(entry, where, "head_stations", 1, fastrak::kFastrakStations);
    if (station == 1 || std::count(stations.begin(), stations.end(), station) == 0 ||
        std::count(heads.begin(), heads.end(), station) > 0) {
      validation::refuse(where, "head_stations", std::to_string(station),
                         "distinct stations listed in ~stations, without 1 (the stylus)");
    }
    heads.push_back(station);
  }
  if (!value.IsSequence()) validation::refuse(where, "head_stations", value.Scalar(), "a list");
  return heads;
}

}  // namespace

TrackerParameters read_tracker_parameters(const YAML::Node& parameters, const std::string& where) {
  TrackerParameters result;
  for (const char* key : {"input", "truth"}) {
    if (parameters[key])
      throw validation::InputError(where + ": " + key +
                                   ": unknown key; it is now the parameter ~input of manipulation");
  }
  if (parameters["source"]) result.source = read_source(parameters["source"], where);
  config::check_keys(parameters, where, "", keys_of(result.source));
  const bool is_motion = result.source == "motion_file" || result.source == "scripted";
  result.even_stamps = result.source == "fastrak";
  if (result.source == "fastrak") result.fastrak = fastrak::read_fastrak_settings(parameters, where);
  if (parameters["head_stations"]) {
    result.head_stations = read_head_stations(parameters["head_stations"], where, result.fastrak.stations);
    if (!result.head_stations.empty()) result.X_BHead = RigidTransform::Identity();
  }
  if (result.source == "joy") result.joy = read_joy_settings(parameters, where);
  constexpr double unbounded = std::numeric_limits<double>::max();
  const auto number = [&](const char* key, const validation::NumberRule& rule, double& value) {
    if (parameters[key]) value = config::read_number(parameters[key], where, key, rule);
  };
  const auto text = [&](const char* key, const char* what, std::string& value) {
    if (parameters[key]) value = config::read_string(parameters[key], where, key);
    if (value.empty() && !parameters[key]) validation::refuse_missing(where, key, what);
    if (value.empty()) validation::refuse(where, key, value, what);
  };
  if (is_motion) text("file", "a motion file", result.file);
  if (result.source == "operator") {
    text("scene", "a path or package:// URI of a URDF with targets", result.scene);
    if (parameters["seed"]) result.seed = config::read_integer(parameters["seed"], where, "seed", 0, 1000000000);
  }
  text("workbench_frame", "a frame name", result.workbench_frame);
  text("stylus_frame", "a frame name", result.stylus_frame);
  text("head_frame", "a frame name", result.head_frame);
  number("rate", validation::not_negative().in("Hz"), result.rate);
  number("speed", validation::between(0.01, 100.0), result.speed);
  number("pause", validation::not_negative().in("s"), result.pause);
  number("grasp_from", validation::not_negative().in("s"), result.grasp_from);
  number("grasp_until", {result.grasp_from, unbounded, false, true, "s"}, result.grasp_until);
  if (parameters["loop"]) result.loop = config::read_bool(parameters["loop"], where, "loop");
  if (parameters["head"]) result.X_BHead = config::read_pose(parameters["head"], where, "head");
  if (parameters["tip"]) {
    const std::vector<double> tip = config::read_numbers(parameters["tip"], where, "tip", 3);
    result.p_ST = Vector3d(tip[0], tip[1], tip[2]);
  }
  number("interpupillary_distance", validation::between(0.0, 0.2).in("m"), result.interpupillary_distance);
  number("dropout_after", validation::positive().in("s"), result.dropout_after);
  if (parameters["even_stamps"])
    result.even_stamps = config::read_bool(parameters["even_stamps"], where, "even_stamps");
  number("latency", validation::between(0.0, 1.0).in("s"), result.latency);
  if (parameters["offset"]) result.X_BT = config::read_pose(parameters["offset"], where, "offset");
  if (parameters["start"]) {
    if (parameters["offset"]) throw validation::InputError(where + ": start: cannot be given together with offset");
    result.X_BS_first = config::read_pose(parameters["start"], where, "start");
  }
  return result;
}

}  // namespace spring_workbench::tracker_driver
