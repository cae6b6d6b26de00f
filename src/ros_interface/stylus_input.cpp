#include "spring_workbench/ros_interface/stylus_input.h"

#include <tf2/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "spring_workbench/ros_interface/loop_clock.h"

namespace spring_workbench {
namespace {

constexpr double smallest_quaternion = 1e-6;
constexpr double furthest = 1e6;  // [m]

std::string frame(const std::string& name) { return !name.empty() && name.front() == '/' ? name.substr(1) : name; }

RigidTransform from_message(const geometry_msgs::Transform& T) {
  return make_transform(Quaterniond(T.rotation.w, T.rotation.x, T.rotation.y, T.rotation.z),
                        Vector3d(T.translation.x, T.translation.y, T.translation.z));
}

geometry_msgs::TransformStamped identity(const std::string& parent, const std::string& child) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.rotation.w = 1.0;
  return transform;
}

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

std::optional<TransformFault> find_fault(const geometry_msgs::TransformStamped& transform) {
  const geometry_msgs::Vector3& p = transform.transform.translation;
  const geometry_msgs::Quaternion& q = transform.transform.rotation;
  const std::string place = "tf " + transform.header.frame_id + " -> " + transform.child_frame_id + ": ";
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
    return TransformFault{"not finite", place + "translation: (" + number(p.x) + ", " + number(p.y) + ", " +
                                            number(p.z) + ") is not allowed: must be three finite numbers"};
  }
  if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > furthest) {
    return TransformFault{"too far", place + "translation: (" + number(p.x) + ", " + number(p.y) + ", " + number(p.z) +
                                         ") is not allowed: must be within " + number(furthest) + " m"};
  }
  const std::string rotation =
      place + "rotation: (" + number(q.x) + ", " + number(q.y) + ", " + number(q.z) + ", " + number(q.w) + ")";
  const double norm = Eigen::Vector4d(q.x, q.y, q.z, q.w).norm();
  if (!std::isfinite(norm)) {
    return TransformFault{"not finite", rotation + " is not allowed: must be four finite numbers"};
  }
  if (norm < smallest_quaternion) {
    return TransformFault{"zero quaternion", rotation + " is not allowed: must be a quaternion that is not zero"};
  }
  return std::nullopt;
}

StylusInput::StylusInput(ros::NodeHandle node, const ManipulationParameters& parameters) : parameters_(parameters) {
  if (parameters.workbench_frame != parameters.world_frame) {
    static_frames_.setTransform(identity(parameters.world_frame, parameters.workbench_frame), "default", true);
  }
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  static_subscriber_ = node.subscribe("/tf_static", 100, &StylusInput::on_static_transforms, this, hints);
  tf_subscriber_ = node.subscribe("/tf", 100, &StylusInput::on_transforms, this, hints);
  joy_subscriber_ = node.subscribe("stylus/joy", 100, &StylusInput::on_joy, this, hints);
}

std::vector<StylusEvent> StylusInput::take_events() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(events_, {});
}

InputStatistics StylusInput::statistics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return statistics_;
}

bool StylusInput::workbench_known() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return workbench_known_;
}

void StylusInput::on_static_transforms(const tf2_msgs::TFMessageConstPtr& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const geometry_msgs::TransformStamped& transform : message->transforms) {
    if (const auto fault = find_fault(transform)) {
      leave_out(fault->reason, fault->line);
      continue;
    }
    geometry_msgs::TransformStamped normalised = transform;
    Eigen::Map<Eigen::Vector4d> q(&normalised.transform.rotation.x);
    q.normalize();
    static_frames_.setTransform(normalised, "tf_static", true);
    if (frame(transform.child_frame_id) == parameters_.workbench_frame) workbench_known_ = true;
  }
}

void StylusInput::on_transforms(const tf2_msgs::TFMessageConstPtr& message) {
  const ros::Time now = ros::Time::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const geometry_msgs::TransformStamped& transform : message->transforms) {
    if (frame(transform.child_frame_id) != parameters_.stylus_frame) continue;
    notice_jump(now);
    if (const auto fault = find_fault(transform)) {
      leave_out(fault->reason, fault->line);
    } else {
      on_stylus(transform, now);
    }
  }
}

void StylusInput::on_stylus(const geometry_msgs::TransformStamped& transform, const ros::Time& now) {
  const ros::Time stamp = transform.header.stamp;
  const std::string place = "tf " + transform.header.frame_id + " -> " + transform.child_frame_id + ": ";
  const double age = (now - stamp).toSec();
  if (std::abs(age) > parameters_.max_age) {
    return leave_out(age > 0.0 ? "too old" : "from the future",
                     place + "stamp: an age of " + number(age) + " s is not allowed: must be within max_age = " +
                         number(parameters_.max_age) + " s (a bag needs --clock and use_sim_time)");
  }
  if (!newest_.isZero() && stamp <= newest_) {
    return leave_out("stamp not later", place + "stamp: " + number((stamp - newest_).toSec()) +
                                            " s after the last one is not allowed: must be > 0 s");
  }
  RigidTransform X_WP = RigidTransform::Identity();
  if (const std::string parent = frame(transform.header.frame_id); parent != parameters_.world_frame) {
    try {
      X_WP = from_message(static_frames_.lookupTransform(parameters_.world_frame, parent, ros::Time()).transform);
    } catch (const tf2::TransformException&) {
      return leave_out("unknown frame", place + "frame_id: " + parent + " is not allowed: must be " +
                                            parameters_.workbench_frame + " or tied to it on /tf_static");
    }
  }
  const double arrival = loop_time();
  if (!newest_.isZero()) {
    statistics_.interval = (stamp - newest_).toSec();
    if (statistics_.interval > parameters_.simulation.dropout_after) ++statistics_.dropouts;
  }
  ++statistics_.samples;
  statistics_.age = age;
  statistics_.newest_arrival = arrival;
  events_.push_back(StylusPose{{seconds(stamp), X_WP * from_message(transform.transform)}, arrival});
  newest_ = stamp;
}

void StylusInput::on_joy(const sensor_msgs::JoyConstPtr& message) {
  const ros::Time now = ros::Time::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  notice_jump(now);
  if (message->buttons.empty()) {
    return leave_out("no buttons", "stylus/joy: buttons: [] is not allowed: must be at least one button");
  }
  const bool pressed = message->buttons[0] != 0;
  if (pressed == pressed_) return;
  pressed_ = pressed;
  const bool usable_stamp = std::abs((now - message->header.stamp).toSec()) <= parameters_.max_age;
  events_.push_back(StylusButton{seconds(usable_stamp ? message->header.stamp : now), pressed});
}

void StylusInput::notice_jump(const ros::Time& now) {
  constexpr double slip = 0.1;  // [s] a clock that is set right by less goes on
  if (!last_now_.isZero() && (last_now_ - now).toSec() > slip) {
    zero_ = newest_ = ros::Time();
    pressed_ = false;
    ++statistics_.restarts;
    ROS_INFO("time went back by %.3g s: starting anew", (last_now_ - now).toSec());
  }
  last_now_ = now;
}

double StylusInput::seconds(const ros::Time& stamp) {
  if (zero_.isZero()) {
    zero_ = stamp;
    events_.push_back(NewEpoch{zero_});
  }
  return (stamp - zero_).toSec();
}

void StylusInput::leave_out(const std::string& reason, const std::string& line) {
  ++statistics_.left_out[reason];
  const ros::WallTime now = ros::WallTime::now();
  const auto told = told_.find(reason);
  if (told != told_.end() && now - told->second < ros::WallDuration(5.0)) return;
  told_[reason] = now;
  ROS_WARN_STREAM(line << "; left out");
}

}  // namespace spring_workbench
