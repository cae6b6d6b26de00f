#include "spring_workbench/motion_files/scripted_source.h"

#include <algorithm>

#include "constants.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/motion/minimum_jerk.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::motion_files {
namespace {

motion::StylusSample read_waypoint(const YAML::Node& node, const std::string& path, const std::string& name) {
  config::check_keys(node, path, name + ".", {"t", "pose", "button"});
  motion::StylusSample waypoint;
  waypoint.t = config::read_required(node, path, name + ".", "t", config::read_number,
                                     validation::between(-farthest_script_time, farthest_script_time).in("s"));
  waypoint.X = config::read_required(node, path, name + ".", "pose", config::read_pose);
  if (node["button"]) waypoint.button = config::read_bool(node["button"], path, name + ".button");
  return waypoint;
}

}  // namespace

ScriptedSource::ScriptedSource(const std::string& path) {
  const YAML::Node script = config::load_yaml_file(path);
  config::check_keys(script, path, "", {"rate", "waypoints"});
  rate_ = config::read_required(script, path, "", "rate", config::read_number, validation::between(0.1, 1e4).in("Hz"));
  const YAML::Node list = script["waypoints"];
  const std::string rule = "a list of at least one {t, pose} or {t, pose, button}";
  if (!list.IsDefined()) validation::refuse_missing(config::place(script, path), "waypoints", rule);
  if (!list.IsSequence() || list.size() == 0) validation::refuse(config::place(list, path), "waypoints", rule);
  double first = 0.0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string name = "waypoints[" + std::to_string(i) + "]";
    motion::StylusSample waypoint = read_waypoint(list[i], path, name);
    if (i == 0) first = waypoint.t;
    waypoint.t -= first;
    if (i > 0 && !(waypoint.t - waypoints_.back().t > closest_samples)) {
      validation::refuse(config::place(list[i], path), name + ".t", list[i]["t"].Scalar(),
                         "a time later than that of the waypoint before");
    }
    if (waypoint.t * rate_ > most_samples) {
      using validation::number_text;
      validation::refuse(config::place(list[i], path), name + ".t", list[i]["t"].Scalar(),
                         "at most " + number_text(most_samples / rate_) + " s after the first (" +
                             number_text(most_samples) + " samples at rate = " + number_text(rate_) + " Hz)");
    }
    waypoints_.push_back(waypoint);
  }
}

std::optional<motion::StylusSample> ScriptedSource::next() {
  if (over_) return std::nullopt;
  const double last = waypoints_.back().t;
  const double t = static_cast<double>(next_++) / rate_;
  over_ = t > last - closest_samples;
  return at(over_ ? last : t);
}

motion::StylusSample ScriptedSource::at(double t) const {
  const auto later = std::upper_bound(waypoints_.begin(), waypoints_.end(), t,
                                      [](double time, const motion::StylusSample& w) { return time < w.t; });
  const motion::StylusSample& a = *(later - 1);
  motion::StylusSample sample = a;
  sample.t = t;
  if (later == waypoints_.end()) return sample;
  sample.X = motion::minimum_jerk_pose(a.X, later->X, (t - a.t) / (later->t - a.t));
  return sample;
}

}  // namespace spring_workbench::motion_files
