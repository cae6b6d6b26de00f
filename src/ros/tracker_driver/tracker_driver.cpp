#include "spring_workbench/ros/tracker_driver/tracker_driver.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "constants.h"
#include "message_source.h"
#include "operator_eyes.h"
#include "spring_workbench/fastrak/station_stream.h"
#include "spring_workbench/motion_files/open_motion.h"
#include "spring_workbench/ros/common/callback_thread.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/ros/common/diagnostic_status.h"
#include "spring_workbench/ros/common/loop_clock.h"
#include "spring_workbench/ros/common/lost_messages.h"
#include "spring_workbench/ros/common/master_watch.h"
#include "spring_workbench/ros/common/parameters.h"
#include "spring_workbench/ros/common/publishing.h"
#include "spring_workbench/ros/tracker_driver/tracker_parameters.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::tracker_driver {
namespace {

/// Converts a path or package:// URI to a path.
std::string resolve(const std::string& path_or_uri) {
  const std::string scheme = "package://";
  if (path_or_uri.rfind(scheme, 0) != 0) return path_or_uri;
  const std::string rest = path_or_uri.substr(scheme.size());
  const std::string package = rest.substr(0, rest.find('/'));
  const std::string folder = scene::find_package_in_ros_package_path(package);
  if (folder.empty()) validation::refuse("", "file", path_or_uri, "a package on ROS_PACKAGE_PATH");
  return folder + rest.substr(package.size());
}

}  // namespace

std::string why_not_sent(const motion::StationSample& sample, const std::string& source) {
  if (!sample.p_TS.allFinite() || !sample.q_TS.coeffs().allFinite()) return "not finite";
  if (std::abs(sample.q_TS.norm() - 1.0) > quaternion_tolerance) return "not a unit quaternion";
  if (source == "fastrak" && sample.p_TS.isZero(0.0) && sample.q_TS.vec().isZero(0.0)) return "out of view";
  return "";
}

std::string eye_frame(const std::string& head_frame, const std::string& eye) {
  const std::string head = "head";
  const std::size_t begin = head_frame.rfind(head);
  if (begin == std::string::npos) return head_frame + "_" + eye;
  return std::string(head_frame).replace(begin, head.size(), eye);
}

namespace {

class TrackerDriver {
 public:
  TrackerDriver(ros::NodeHandle node, const ros::NodeHandle& private_node)
      : parameters_(read_tracker_parameters(ros_common::private_parameters(private_node), private_node.getNamespace())),
        name_(private_node.getNamespace()),
        X_BT_(parameters_.X_BT),
        diagnostics_publisher_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)) {
    joy_publishers_[1] = node.advertise<sensor_msgs::Joy>("stylus/joy", 100);
    std::vector<int> styluses = parameters_.fastrak.styluses;
    if (parameters_.source == "operator") {
      scene_ = scene::load_scene(parameters_.scene, {}, name_ + ": scene");
      eyes_ = std::make_unique<OperatorEyes>(node, scene_.X_WH_start.size());
      styluses.resize(scene_.X_WH_start.size());
      std::iota(styluses.begin(), styluses.end(), 1);
    }
    for (const int station : styluses) {
      if (station == 1) continue;
      joy_publishers_[station] = node.advertise<sensor_msgs::Joy>("stylus_" + std::to_string(station) + "/joy", 100);
    }
    if (eyes_) return;
    device_ = open_device(node, private_node);
    if (device_) return;
    const auto first = open()->next();
    if (!first) validation::refuse("", parameters_.file, "at least one sample");
    if (parameters_.X_BS_first) X_BT_ = *parameters_.X_BS_first * first->X.inverse();
  }

  ~TrackerDriver() { master_thread_.stop(); }
  TrackerDriver(const TrackerDriver&) = delete;
  TrackerDriver& operator=(const TrackerDriver&) = delete;

  void run() {
    send_eyes();
    if (device_) return stream();
    do {
      play();
    } while (parameters_.loop && ros::ok());
    over_ = true;
    while (ros::ok()) wait_until(ros_common::loop_time() + 1.0);
  }

 private:
  std::unique_ptr<motion::StylusSource> open() {
    if (eyes_) {
      assembly::OperatorSettings settings;
      settings.seed = static_cast<unsigned>(parameters_.seed);
      eyes_->wait();
      return std::make_unique<assembly::SimulatedOperator>(scene_, settings, [this] { return eyes_->look(); });
    }
    return motion_files::open_motion(resolve(parameters_.file));
  }

  /// Returns the device; null if the source is a motion.
  std::unique_ptr<motion::LiveSource> open_device(const ros::NodeHandle& node,
                                                  const ros::NodeHandle& private_node) const {
    const RigidTransform above = make_transform(Vector3d(0.0, 0.0, 0.4), Quaterniond(0.0, 1.0, 0.0, 0.0));
    const RigidTransform X_WB = parameters_.X_BS_first.value_or(above);
    if (parameters_.source == "fastrak") return std::make_unique<fastrak::FastrakSource>(parameters_.fastrak);
    if (parameters_.source == "joy") return make_joy_source(node, parameters_.joy, X_WB);
    if (parameters_.source == "mouse") {
      return make_interactive_marker_source(private_node, parameters_.workbench_frame, X_WB);
    }
    return nullptr;
  }

  /// Publishes the eyes side by side in head axes: x forward, y left (REP 103).
  void send_eyes() {
    std::vector<geometry_msgs::TransformStamped> eyes;
    for (std::size_t head = 0; head < std::max<std::size_t>(parameters_.head_stations.size(), 1); ++head) {
      for (const auto& [name, side] : {std::pair("eye_left", 0.5), std::pair("eye_right", -0.5)}) {
        const Vector3d p(0.0, side * parameters_.interpupillary_distance, 0.0);
        eyes.push_back(ros_common::to_transform(make_transform(p, Quaterniond::Identity()), head_frame(head),
                                                eye_frame(head_frame(head), name), ros::Time::now()));
      }
    }
    static_transforms_.sendTransform(eyes);
  }

  void play() {
    const std::unique_ptr<motion::StylusSource> source = open();
    ros::Time::waitForValid();
    const double start = ros_common::loop_time() + parameters_.pause;
    ++passes_;
    std::map<std::size_t, double> newest;  // time of the newest sample sent per hand [s]
    double newest_of_all = -std::numeric_limits<double>::infinity();
    ros::Time stamp;
    const double shortest = parameters_.rate > 0.0 ? 1.0 / parameters_.rate : 0.0;
    while (ros::ok()) {
      auto sample = source->next();
      if (!sample) return;
      const double t = sample->t / parameters_.speed;
      double& last = newest.try_emplace(sample->hand, -std::numeric_limits<double>::infinity()).first->second;
      if (t <= last || t < last + shortest - stamp_slack) {
        ++not_sent_;
        continue;
      }
      wait_until(start + t);
      interval_ = t - last;
      last = t;
      // The two clocks are read one after the other: hands that move at one time would get two stamps.
      if (t != std::exchange(newest_of_all, t))
        stamp = ros::Time::now() - ros::Duration(ros_common::loop_time() - (start + t));
      send(*sample, stamp);
    }
  }

  void send(const motion::StylusSample& sample, const ros::Time& stamp) {
    const int station = static_cast<int>(sample.hand) + 1;
    transforms_.sendTransform(
        {ros_common::to_transform(X_BT_ * sample.X * Eigen::Translation3d(parameters_.p_ST),
                                  parameters_.workbench_frame, frame_of(station), stamp),
         ros_common::to_transform(parameters_.X_BHead, parameters_.workbench_frame, parameters_.head_frame, stamp)});
    const bool held = sample.t >= parameters_.grasp_from && sample.t < parameters_.grasp_until;
    send_buttons(station, {sample.button || held}, stamp);
    ++sent_;
  }

  struct Buttons {
    bool grasp = false, next_tool = false, clutch = false;
  };
  void send_buttons(int station, const Buttons& down, const ros::Time& stamp) {
    sensor_msgs::Joy joy;
    joy.header.stamp = stamp;
    joy.header.frame_id = frame_of(station);
    joy.buttons = {down.grasp ? 1 : 0, down.next_tool ? 1 : 0, down.clutch ? 1 : 0};
    joy_publishers_.at(station).publish(joy);
  }

  void stream() {
    ros::Time::waitForValid();
    while (ros::ok()) {
      for (const motion::StationSample& sample : device_->read(longest_slice)) send(sample);
      if (ros_common::loop_time() >= next_diagnostics_) {
        publish_diagnostics();
        next_diagnostics_ = ros_common::loop_time() + 1.0;
      }
    }
  }

  /// The pose first, which the display waits for.
  void send(const motion::StationSample& sample) {
    send_pose(sample);
    if (joy_publishers_.count(sample.station) > 0) {
      send_buttons(sample.station, {sample.button, sample.next_tool, sample.clutch},
                   ros_common::ros_time(sample.received - parameters_.latency));
    }
  }

  void send_pose(const motion::StationSample& sample) {
    Station& station = stations_.try_emplace(sample.station, parameters_).first->second;
    const double t = station.stream.stamp(sample.received) - parameters_.latency;
    const double shortest = parameters_.rate > 0.0 ? 1.0 / parameters_.rate : 0.0;
    std::string reason = why_not_sent(sample, parameters_.source);
    if (reason.empty() && t <= station.newest) reason = "stamp not later";
    if (reason.empty() && t - station.newest < shortest) reason = "above ~rate";
    if (!reason.empty()) {
      ++station.not_sent[reason];
      ++not_sent_;
      return;
    }
    const ros::Time stamp = ros_common::ros_time(t);
    std::vector<geometry_msgs::TransformStamped> transforms{
        transform_of(sample.station, make_transform(sample.p_TS, sample.q_TS), stamp)};
    if (sample.station == parameters_.fastrak.stations.front()) {
      if (parameters_.head_stations.empty()) {
        transforms.push_back(
            ros_common::to_transform(parameters_.X_BHead, parameters_.workbench_frame, parameters_.head_frame, stamp));
      }
      interval_ = t - station.newest;
    }
    transforms_.sendTransform(transforms);
    station.newest = t;
    ++sent_;
  }

  std::string head_frame(std::size_t head) const { return parameters_.head_frame + ros_common::hand_suffix(head); }

  /// Number, from 0, of the head that wears the station.
  std::optional<std::size_t> head_of(int station) const {
    const auto& heads = parameters_.head_stations;
    const auto found = std::find(heads.begin(), heads.end(), station);
    if (found == heads.end()) return std::nullopt;
    return static_cast<std::size_t>(found - heads.begin());
  }

  std::string frame_of(int station) const {
    if (station == 1) return parameters_.stylus_frame;
    if (const std::optional<std::size_t> head = head_of(station)) return head_frame(*head);
    return parameters_.stylus_frame + "_" + std::to_string(station);
  }

  geometry_msgs::TransformStamped transform_of(int station, const RigidTransform& X_TS, const ros::Time& stamp) const {
    RigidTransform X_BF = X_BT_ * X_TS;
    if (station == 1) {
      X_BF = X_BF * Eigen::Translation3d(parameters_.p_ST);
    } else if (head_of(station)) {
      X_BF = X_BF * parameters_.X_BHead;
    }
    return ros_common::to_transform(X_BF, parameters_.workbench_frame, frame_of(station), stamp);
  }

  void wait_until(double t) {
    for (double now = ros_common::loop_time(); now < t && ros::ok(); now = ros_common::loop_time()) {
      if (now >= next_diagnostics_ || now < next_diagnostics_ - 1.0) {
        publish_diagnostics();
        next_diagnostics_ = now + 1.0;
      }
      ros_common::sleep_until_loop_time(std::min(t, now + longest_slice));
    }
  }

  void add_health(ros_common::DiagnosticStatusBuilder& status) const {
    const motion::SourceHealth health = device_->health();
    for (const auto& [name, count] : health.counters) status.add(name, count);
    status.add("state", health.text);
    if (health.streaming) return;
    status.raise(diagnostic_msgs::DiagnosticStatus::ERROR, health.text);
    ROS_WARN_STREAM_THROTTLE(5.0, health.text);
  }

  void publish_diagnostics() {
    ros_common::DiagnosticStatusBuilder status(name_ + ": source", parameters_.source);
    status.add("samples sent", sent_)
        .add("samples not sent", not_sent_)
        .add("rate [Hz]", interval_ > 0.0 ? 1.0 / interval_ : 0.0);
    if (device_) {
      add_health(status);
    } else {
      status.add("file", parameters_.file).add("passes", passes_);
    }
    if (over_) status.add("state", "over");
    diagnostic_msgs::DiagnosticArray message;
    message.header.stamp = ros::Time::now();
    message.status = {status.status()};
    for (const auto& [number, station] : stations_) {
      ros_common::DiagnosticStatusBuilder of_station(name_ + ": station " + std::to_string(number), parameters_.source);
      ros_common::add_stream(station.stream.figures(), of_station);
      for (const auto& [reason, count] : station.not_sent) of_station.add("not sent: " + reason, count);
      message.status.push_back(of_station.status());
    }
    message.status.push_back(lost_messages_.report(name_));
    diagnostics_publisher_.publish(message);
  }

  const TrackerParameters parameters_;
  const std::string name_;
  std::unique_ptr<motion::LiveSource> device_;
  struct Station {
    explicit Station(const TrackerParameters& p) : stream(p.dropout_after, p.even_stamps) {}
    fastrak::StationStream stream;
    double newest = -std::numeric_limits<double>::infinity();  ///< stamp of the last sample sent [s, steady clock]
    std::map<std::string, std::size_t> not_sent;               ///< by reason
  };
  std::map<int, Station> stations_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  RigidTransform X_BT_;
  scene::Scene scene_;                  ///< scene of the operator
  std::unique_ptr<OperatorEyes> eyes_;  ///< view of the operator
  std::size_t sent_ = 0, not_sent_ = 0, passes_ = 0;
  double interval_ = 0.0;  ///< time between the last two samples sent [s]
  bool over_ = false;
  double next_diagnostics_ = 0.0;
  tf2_ros::TransformBroadcaster transforms_;
  std::map<int, ros::Publisher> joy_publishers_;  ///< by station
  ros_common::LostMessages lost_messages_;
  ros::Publisher diagnostics_publisher_;
  ros_common::CallbackThread master_thread_{"master"};
  ros_common::MasterWatch master_watch_{master_thread_.handle(ros::NodeHandle())};
};

}  // namespace

void run(const ros::NodeHandle& node, const ros::NodeHandle& private_node) { TrackerDriver(node, private_node).run(); }

}  // namespace spring_workbench::tracker_driver
