#include "spring_workbench/ros/manipulation/stylus_input.h"

#include <tf2/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "constants.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/ros/common/loop_clock.h"

namespace spring_workbench::manipulation {
namespace {

std::string frame(const std::string& name) { return !name.empty() && name.front() == '/' ? name.substr(1) : name; }

std::string place(const std::string& parent, const std::string& child) {
  return "tf " + parent + " -> " + child + ": ";
}

std::string place(const geometry_msgs::TransformStamped& transform) {
  return place(transform.header.frame_id, transform.child_frame_id);
}

geometry_msgs::TransformStamped identity(const std::string& parent, const std::string& child) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.rotation.w = 1.0;
  return transform;
}

hand_input::RawSample raw(const geometry_msgs::Transform& T, double t) {
  return {t, Vector3d(T.translation.x, T.translation.y, T.translation.z),
          Quaterniond(T.rotation.w, T.rotation.x, T.rotation.y, T.rotation.z)};
}

/// Keeps the newest few.
template <typename Message>
void keep(const Message& message, std::deque<Message>& kept) {
  kept.push_back(message);
  if (kept.size() > most_early) kept.pop_front();
}

/// What was kept since time went back for the last time.
template <typename Message>
std::deque<Message> newest_pass(std::deque<Message> kept) {
  for (std::size_t i = kept.size(); i-- > 1;) {
    if ((kept[i - 1].header.stamp - kept[i].header.stamp).toSec() <= clock_slip) continue;
    kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(i));
    break;
  }
  return kept;
}

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

StylusInput::StylusInput(ros::NodeHandle node, const ManipulationParameters& parameters, std::string frame,
                         std::string joy, std::function<void()> wake)
    : parameters_(parameters), frame_(std::move(frame)), joy_(std::move(joy)), wake_(std::move(wake)) {
  if (parameters.workbench_frame != parameters.world_frame) {
    static_frames_.setTransform(identity(parameters.world_frame, parameters.workbench_frame), "default", true);
  }
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  static_subscriber_ = node.subscribe("/tf_static", 100, &StylusInput::on_static_transforms, this, hints);
  tf_subscriber_ = node.subscribe("/tf", input_queue, &StylusInput::on_transforms, this, hints);
  joy_subscriber_ = node.subscribe(joy_, input_queue, &StylusInput::on_joy, this, hints);
}

std::vector<live::StylusEvent> StylusInput::take_events() {
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
    const hand_input::RawSample sample = raw(transform.transform, 0.0);
    const hand_input::GateResult result = hand_input::check_pose(sample, parameters_.input);
    if (!hand_input::usable(result)) {
      reject(hand_input::to_string(result),
             place(transform) + hand_input::complaint(result, sample, parameters_.input));
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
  const std::lock_guard<std::mutex> lock(mutex_);
  ++statistics_.messages;
  for (const geometry_msgs::TransformStamped& transform : event.getMessage()->transforms) {
    if (statistics_.frames.size() < most_named_frames) statistics_.frames.insert(frame(transform.child_frame_id));
    if (frame(transform.child_frame_id) != frame_) continue;
    if (const std::optional<ros::Time> now = moment_of(transform.header.stamp, poses_)) {
      on_stylus(transform, *now);
    } else {
      keep(transform, early_poses_);
      start_anew_when_due();
    }
  }
}

void StylusInput::on_stylus(const geometry_msgs::TransformStamped& transform, const ros::Time& now) {
  const double age = (now - transform.header.stamp).toSec();
  statistics_.newest_offer_age = age;
  if (ros::Time::isSimTime() && (poses_.newest - transform.header.stamp).toSec() > clock_slip)
    keep(transform, early_poses_);
  if (std::abs(age) > parameters_.max_age) {
    return reject(age > 0.0 ? "too old" : "from the future",
                  place(transform) + "stamp: an age of " + number(age) + " s is not allowed: must be within " +
                      "max_age = " + number(parameters_.max_age) + " s (a bag needs --clock and use_sim_time)");
  }
  RigidTransform X_WP = RigidTransform::Identity();
  if (const std::string parent = frame(transform.header.frame_id); parent != parameters_.world_frame) {
    try {
      X_WP = ros_common::from_message(
          static_frames_.lookupTransform(parameters_.world_frame, parent, ros::Time()).transform);
    } catch (const tf2::TransformException&) {
      return reject("unknown frame", place(transform) + "frame_id: " + parent + " is not allowed: must be " +
                                         parameters_.workbench_frame + " or tied to it on /tf_static");
    }
  }
  go_on_to(transform.header.stamp, poses_, early_poses_);
  const hand_input::RawSample sample = raw(transform.transform, seconds(transform.header.stamp));
  events_.push_back(live::StylusPose{sample, transform.header.frame_id, X_WP, ros_common::local_time(), age});
  wake_();
}

void StylusInput::count_rejected(const std::vector<live::RejectedPose>& poses) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [result, pose] : poses) {
    reject(hand_input::to_string(result),
           place(pose.parent, frame_) + hand_input::complaint(result, pose.sample, parameters_.input));
  }
}

void StylusInput::on_joy(const sensor_msgs::JoyConstPtr& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  // Without a clock yet there is no time that it could be of: an epoch that it began would be followed by the true one.
  if (ros::Time::now().isZero()) return reject("no clock", joy_ + ": no time on /clock yet");
  if (message->buttons.empty()) {
    return reject("no buttons", joy_ + ": buttons: [] is not allowed: must be at least one button");
  }
  if (const std::optional<ros::Time> now = moment_of(message->header.stamp, buttons_))
    return on_buttons(*message, *now);
  keep(*message, early_buttons_);
  start_anew_when_due();
}

void StylusInput::on_buttons(const sensor_msgs::Joy& message, const ros::Time& now) {
  const ros::Time& stamp = message.header.stamp;
  if (ros::Time::isSimTime() && !stamp.isZero() && (buttons_.newest - stamp).toSec() > clock_slip) {
    return keep(message, early_buttons_);
  }
  const bool usable_stamp = std::abs((now - stamp).toSec()) <= parameters_.max_age;
  const double t = seconds(usable_stamp ? stamp : now);
  if (usable_stamp) go_on_to(stamp, buttons_, early_buttons_);
  const bool pressed = message.buttons[0] != 0;
  if (pressed != pressed_) events_.push_back(live::StylusButton{t, pressed});
  pressed_ = pressed;
  const bool next_tool = message.buttons.size() > 1 && message.buttons[1] != 0;
  if (next_tool && !next_tool_) events_.push_back(live::NextTool{t});
  next_tool_ = next_tool;
  events_.push_back(live::ButtonsKnown{t, ros_common::local_time()});
  wake_();
}

/// A stream that goes on shows that what was kept of it was out of order, and not after a jump.
template <typename Message>
void StylusInput::go_on_to(const ros::Time& stamp, Stream& stream, std::deque<Message>& early) {
  if (stamp <= stream.newest) return;
  stream.newest = stamp;
  early.clear();
}

/// The time now, for a message with this stamp of this stream; nothing when it belongs to the time after a jump back
/// for which it has to wait. The clock and both streams come by ways of their own, and what was sent before the jump
/// may come after it: a stamp that goes on where its stream was, near what the clock said then, belongs to the time
/// before.
std::optional<ros::Time> StylusInput::moment_of(const ros::Time& stamp, Stream& stream) {
  const ros::Time now = ros::Time::now();
  // The clock went back; or the whole way back was missed, and only the stamps show it.
  const bool clock_jumped = !last_now_.isZero() && (last_now_ - now).toSec() > clock_slip;
  const bool stamps_jumped = ros::Time::isSimTime() && !stream.newest.isZero() &&
                             (stream.newest - stamp).toSec() > clock_slip && (stream.newest - now).toSec() > clock_slip;
  if (!jumped_ && (clock_jumped || stamps_jumped)) {
    jumped_ = true;
    jumped_at_ = ros_common::local_time().attended;
  }
  if (!jumped_) last_now_ = now;
  const bool goes_on = ros::Time::isSimTime() && !stream.newest.isZero() && stamp > stream.newest &&
                       std::abs((last_now_ - stamp).toSec()) < parameters_.max_age;
  if (jumped_ && !goes_on) return std::nullopt;
  return last_now_;
}

/// Starts anew unless a stream that there is has not come to the jump yet.
void StylusInput::start_anew_when_due() {
  const bool patient = ros::Time::isSimTime() && ros_common::local_time().attended - jumped_at_ < jump_patience;
  const bool poses_awaited = !poses_.newest.isZero() && early_poses_.empty();
  const bool buttons_awaited = !buttons_.newest.isZero() && early_buttons_.empty();
  if (patient && (poses_awaited || buttons_awaited)) return;
  const ros::Time now = ros::Time::now();
  ROS_INFO("time went back by %.3g s: starting anew", (last_now_ - now).toSec());
  jumped_ = pressed_ = next_tool_ = false;
  zero_ = poses_.newest = buttons_.newest = ros::Time();
  last_now_ = now;
  ++statistics_.restarts;
  // By now the clock of a bag that is played quickly may be far on: what waited is as old as it was.
  const auto came_at = [&](const ros::Time& stamp) { return ros::Time::isSimTime() && !stamp.isZero() ? stamp : now; };
  for (const geometry_msgs::TransformStamped& transform : newest_pass(std::exchange(early_poses_, {}))) {
    on_stylus(transform, came_at(transform.header.stamp));
  }
  for (const sensor_msgs::Joy& message : newest_pass(std::exchange(early_buttons_, {}))) {
    on_buttons(message, came_at(message.header.stamp));
  }
}

double StylusInput::seconds(const ros::Time& stamp) {
  if (zero_.isZero()) {
    // In simulated time a whole second: a bag played again gives the same times to the bit, whatever comes first.
    zero_ = ros::Time::isSimTime() && stamp.sec > 0 ? ros::Time(stamp.sec, 0) : stamp;
    events_.push_back(live::NewEpoch{static_cast<std::int64_t>(zero_.toNSec())});
  }
  return (stamp - zero_).toSec();
}

void StylusInput::reject(const std::string& reason, const std::string& line) {
  ++statistics_.rejected[reason];
  const ros::WallTime now = ros::WallTime::now();
  const auto told = told_.find(reason);
  if (told != told_.end() && now - told->second < ros::WallDuration(told_again_after)) return;
  told_[reason] = now;
  ROS_WARN_STREAM(line << "; left out");
}

}  // namespace spring_workbench::manipulation
