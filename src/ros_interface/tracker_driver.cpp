#include "spring_workbench/ros_interface/tracker_driver.h"

#include <sensor_msgs/Joy.h>

#include <algorithm>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/ros_interface/conversions.h"
#include "spring_workbench/ros_interface/diagnostics.h"
#include "spring_workbench/ros_interface/loop_clock.h"
#include "spring_workbench/ros_interface/parameters.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tracker/motion_file.h"
#include "spring_workbench/tracker/scripted_source.h"

namespace spring_workbench {
namespace {

/// A path or package:// URI as a path.
std::string resolve(const std::string& path_or_uri) {
  const std::string scheme = "package://";
  if (path_or_uri.rfind(scheme, 0) != 0) return path_or_uri;
  const std::string rest = path_or_uri.substr(scheme.size());
  const std::string package = rest.substr(0, rest.find('/'));
  const std::string folder = find_package_in_ros_package_path(package);
  if (folder.empty()) refuse("file", "package", package, "a package on ROS_PACKAGE_PATH");
  return folder + rest.substr(package.size());
}

}  // namespace

TrackerParameters read_tracker_parameters(const YAML::Node& parameters, const std::string& where) {
  check_keys(parameters, where, "",
             {"source", "file", "scene", "seed", "rate", "speed", "loop", "pause", "workbench_frame", "stylus_frame", "head_frame",
              "offset", "start", "head", "grasp_from", "grasp_until"});
  constexpr double unbounded = std::numeric_limits<double>::max();
  TrackerParameters result;
  const auto number = [&](const char* key, const NumberRule& rule, double& value) {
    if (parameters[key]) value = read_number(parameters[key], where, key, rule);
  };
  const auto text = [&](const char* key, std::string& value) {
    if (parameters[key]) value = read_string(parameters[key], where, key);
    if (value.empty()) refuse(where, key, "(nothing)", "a string that is not empty");
  };
  if (parameters["source"]) {
    result.source = read_choice(parameters["source"], where, "source", {"motion_file", "scripted", "operator"});
  }
  if (result.source == "operator") {
    text("scene", result.scene);
    if (parameters["seed"]) result.seed = read_integer(parameters["seed"], where, "seed", 0, 1000000000);
  } else {
    text("file", result.file);
  }
  text("workbench_frame", result.workbench_frame);
  text("stylus_frame", result.stylus_frame);
  text("head_frame", result.head_frame);
  number("rate", not_negative(), result.rate);
  number("speed", between(0.01, 100.0), result.speed);
  number("pause", not_negative(), result.pause);
  number("grasp_from", not_negative(), result.grasp_from);
  number("grasp_until", {result.grasp_from, unbounded, false, true}, result.grasp_until);
  if (parameters["loop"]) result.loop = read_bool(parameters["loop"], where, "loop");
  if (parameters["head"]) result.X_BHead = read_pose(parameters["head"], where, "head");
  if (parameters["offset"]) result.X_BT = read_pose(parameters["offset"], where, "offset");
  if (parameters["start"]) {
    if (parameters["offset"]) throw InputError(where + ": start: is not allowed beside offset: must be one of the two");
    result.X_BS_first = read_pose(parameters["start"], where, "start");
  }
  return result;
}

TrackerDriver::TrackerDriver(ros::NodeHandle node, ros::NodeHandle private_node)
    : parameters_(read_tracker_parameters(private_parameters(private_node), private_node.getNamespace())),
      name_(private_node.getNamespace()),
      X_BT_(parameters_.X_BT),
      joy_publisher_(node.advertise<sensor_msgs::Joy>("stylus/joy", 100)),
      diagnostics_publisher_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)) {
  if (parameters_.source == "operator") {
    eyes_ = std::make_unique<OperatorEyes>(node);
    return;
  }
  const auto first = open()->next();
  if (!first) throw InputError(parameters_.file + ": no samples: must be at least one");
  if (parameters_.X_BS_first) X_BT_ = *parameters_.X_BS_first * first->X.inverse();
}

std::unique_ptr<StylusSource> TrackerDriver::open() {
  if (eyes_) {
    OperatorSettings settings;
    settings.seed = static_cast<unsigned>(parameters_.seed);
    eyes_->wait();
    return std::make_unique<SimulatedOperator>(load_scene(parameters_.scene), settings, [this] { return eyes_->look(); });
  }
  const std::string path = resolve(parameters_.file);
  if (parameters_.source == "scripted") return std::make_unique<ScriptedSource>(path);
  return std::make_unique<RecordedSource>(read_motion_file(path));
}

void TrackerDriver::run() {
  do {
    play();
  } while (parameters_.loop && ros::ok());
  over_ = true;
  while (ros::ok()) wait_until(loop_time() + 1.0);
}

void TrackerDriver::play() {
  const std::unique_ptr<StylusSource> source = open();
  ros::Time::waitForValid();
  const double start = loop_time() + parameters_.pause;
  ++passes_;
  double last = -std::numeric_limits<double>::infinity();  // time of the newest sample sent [s]
  const double shortest = parameters_.rate > 0.0 ? 1.0 / parameters_.rate : 0.0;
  constexpr double slack = 1e-6;  // [s] rounding of stamps
  while (ros::ok()) {
    const auto sample = source->next();
    if (!sample) return;
    const double t = sample->t / parameters_.speed;
    if (t <= last || t < last + shortest - slack) {
      ++left_out_;
      continue;
    }
    wait_until(start + t);
    interval_ = t - last;
    last = t;
    send(*sample, ros::Time::now() - ros::Duration(loop_time() - (start + t)));
  }
}

void TrackerDriver::send(const StylusSample& sample, const ros::Time& stamp) {
  transforms_.sendTransform(
      {to_transform(X_BT_ * sample.X, parameters_.workbench_frame, parameters_.stylus_frame, stamp),
       to_transform(parameters_.X_BHead, parameters_.workbench_frame, parameters_.head_frame, stamp)});
  sensor_msgs::Joy joy;
  joy.header.stamp = stamp;
  joy.header.frame_id = parameters_.stylus_frame;
  const bool grasp = sample.button || (sample.t >= parameters_.grasp_from && sample.t < parameters_.grasp_until);
  joy.buttons = {grasp ? 1 : 0, 0};
  joy_publisher_.publish(joy);
  ++sent_;
}

void TrackerDriver::wait_until(double t) {
  constexpr double slice = 0.1;  // [s] between looks at what else is due
  for (double now = loop_time(); now < t && ros::ok(); now = loop_time()) {
    if (now >= next_diagnostics_ || now < next_diagnostics_ - 1.0) {
      publish_diagnostics();
      next_diagnostics_ = now + 1.0;
    }
    sleep_until_loop_time(std::min(t, now + slice));
  }
}

void TrackerDriver::publish_diagnostics() {
  DiagnosticStatusBuilder status(name_ + ": source", parameters_.source);
  status.add("file", parameters_.file)
      .add("samples sent", sent_)
      .add("samples left out", left_out_)
      .add("rate [Hz]", interval_ > 0.0 ? 1.0 / interval_ : 0.0)
      .add("passes", passes_);
  if (over_) status.add("state", "over");
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ros::Time::now();
  message.status = {status.status()};
  diagnostics_publisher_.publish(message);
}

}  // namespace spring_workbench
