#include "spring_workbench/ros_interface/stylus_input.h"

#include <tf2/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "spring_workbench/ros_interface/loop_clock.h"

namespace spring_workbench {
namespace {

std::string frame(const std::string& name) { return !name.empty() && name.front() == '/' ? name.substr(1) : name; }

RigidTransform from_message(const geometry_msgs::Transform& T) {
  return make_transform(Quaterniond(T.rotation.w, T.rotation.x, T.rotation.y, T.rotation.z),
                        Vector3d(T.translation.x, T.translation.y, T.translation.z));
}

std::string place(const geometry_msgs::TransformStamped& transform) {
  return "tf " + transform.header.frame_id + " -> " + transform.child_frame_id + ": ";
}

geometry_msgs::TransformStamped identity(const std::string& parent, const std::string& child) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.rotation.w = 1.0;
  return transform;
}

RawSample raw(const geometry_msgs::Transform& T, double t) {
  return {t, Vector3d(T.translation.x, T.translation.y, T.translation.z),
          Quaterniond(T.rotation.w, T.rotation.x, T.rotation.y, T.rotation.z)};
}

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

StylusInput::StylusInput(ros::NodeHandle node, const ManipulationParameters& parameters)
    : parameters_(parameters),
      truth_(parameters.truth, parameters.simulation.dropout_after),
      monitor_(parameters.simulation.dropout_after) {
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
    const RawSample sample = raw(transform.transform, 0.0);
    const Verdict verdict = SampleGate(parameters_.truth, parameters_.simulation.dropout_after).offer(sample);
    if (!usable(verdict)) {
      leave_out(to_string(verdict), place(transform) + complaint(verdict, sample, parameters_.truth));
      continue;
    }
    geometry_msgs::TransformStamped normalised = transform;
    Eigen::Map<Eigen::Vector4d> q(&normalised.transform.rotation.x);
    q.normalize();
    static_frames_.setTransform(normalised, "tf_static", true);
    if (frame(transform.child_frame_id) == parameters_.workbench_frame) workbench_known_ = true;
  }
}

void StylusInput::on_transforms(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
  if (event.getPublisherName() == ros::this_node::getName()) return;
  const ros::Time now = ros::Time::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  ++statistics_.messages;
  for (const geometry_msgs::TransformStamped& transform : event.getMessage()->transforms) {
    constexpr std::size_t most_frames = 20;  // that a hint can name
    if (statistics_.frames.size() < most_frames) statistics_.frames.insert(frame(transform.child_frame_id));
    if (frame(transform.child_frame_id) != parameters_.stylus_frame) continue;
    notice_jump(now);
    on_stylus(transform, now);
  }
}

void StylusInput::on_stylus(const geometry_msgs::TransformStamped& transform, const ros::Time& now) {
  const double age = (now - transform.header.stamp).toSec();
  statistics_.newest_offer_age = age;
  if (std::abs(age) > parameters_.max_age) {
    if (age > 0.0 && ros::Time::isSimTime()) {
      constexpr std::size_t most = 20;
      early_.push_back(transform);
      if (early_.size() > most) early_.pop_front();
    }
    return leave_out(age > 0.0 ? "too old" : "from the future",
                     place(transform) + "stamp: an age of " + number(age) + " s is not allowed: must be within " +
                         "max_age = " + number(parameters_.max_age) + " s (a bag needs --clock and use_sim_time)");
  }
  RigidTransform X_WP = RigidTransform::Identity();
  if (const std::string parent = frame(transform.header.frame_id); parent != parameters_.world_frame) {
    try {
      X_WP = from_message(static_frames_.lookupTransform(parameters_.world_frame, parent, ros::Time()).transform);
    } catch (const tf2::TransformException&) {
      return leave_out("unknown frame", place(transform) + "frame_id: " + parent + " is not allowed: must be " +
                                            parameters_.workbench_frame + " or tied to it on /tf_static");
    }
  }
  offer(transform, X_WP, age);
}

void StylusInput::offer(const geometry_msgs::TransformStamped& transform, const RigidTransform& X_WP, double age) {
  const RawSample sample = raw(transform.transform, seconds(transform.header.stamp));
  const TrueSample taken = truth_.take(sample);
  statistics_.gate = truth_.counts();
  if (!usable(taken.verdict)) {
    return leave_out(to_string(taken.verdict), place(transform) + complaint(taken.verdict, sample, parameters_.truth));
  }
  const LocalTime arrival = local_time();
  monitor_.sample(sample.t, sample.t + age);
  statistics_.stream = monitor_.figures();
  statistics_.newest_arrival = arrival.loop;
  events_.push_back(
      StylusPose{{sample.t, X_WP * taken.sample.X}, arrival, taken.verdict == Verdict::new_place});
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
    zero_ = ros::Time();
    pressed_ = false;
    truth_.restart();
    monitor_.restart();
    ++statistics_.restarts;
    ROS_INFO("time went back by %.3g s: starting anew", (last_now_ - now).toSec());
    for (const geometry_msgs::TransformStamped& transform : std::exchange(early_, {})) on_stylus(transform, now);
  }
  last_now_ = now;
}

double StylusInput::seconds(const ros::Time& stamp) {
  if (zero_.isZero()) {
    // In simulated time a whole second: a bag played again gives the same times to the bit, whatever comes first.
    zero_ = ros::Time::isSimTime() && stamp.sec > 0 ? ros::Time(stamp.sec, 0) : stamp;
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
