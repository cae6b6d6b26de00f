#include "spring_workbench/ros/manipulation/stylus_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "constants.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/ros/common/loop_clock.h"
#include "spring_workbench/ros/common/publishing.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::manipulation {
namespace {

std::string place_of(const geometry_msgs::TransformStamped& transform) {
  return place(transform.header.frame_id, transform.child_frame_id);
}

}  // namespace

StylusInput::StylusInput(const ros::NodeHandle& node, const ManipulationParameters& parameters, std::size_t hand,
                         std::function<void()> wake)
    : parameters_(parameters),
      frame_(parameters.stylus_frame + ros_common::hand_suffix(hand)),
      joy_("stylus" + ros_common::hand_suffix(hand) + "/joy"),
      wake_(std::move(wake)),
      static_frames_(parameters.world_frame, parameters.workbench_frame),
      sender_(parameters.simulation.dropout_after),
      wall_poses_(parameters.max_age),
      wall_buttons_(parameters.max_age),
      events_(max_waiting),
      early_poses_(max_early_messages),
      early_buttons_(max_early_messages) {
  using ros_common::CountedSubscriber;
  static_subscriber_ = CountedSubscriber::to<const tf2_msgs::TFMessageConstPtr&>(
      node, "/tf_static", 100, [this](const auto& message) { on_static_transforms(message); });
  tf_subscriber_ = CountedSubscriber::to<const ros::MessageEvent<const tf2_msgs::TFMessage>&>(
      node, "/tf", input_queue, [this](const auto& event) { on_transforms(event); });
  joy_subscriber_ = CountedSubscriber::to<const sensor_msgs::JoyConstPtr&>(
      node, joy_, input_queue, [this](const auto& message) { on_joy(message); });
}

std::vector<live::StylusEvent> StylusInput::take_events() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return events_.take();
}

InputStatistics StylusInput::statistics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  InputStatistics statistics = statistics_;
  statistics.rejected = rejections_.counts();
  return statistics;
}

bool StylusInput::workbench_known() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_frames_.workbench_known();
}

void StylusInput::on_static_transforms(const tf2_msgs::TFMessageConstPtr& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const geometry_msgs::TransformStamped& transform : message->transforms) {
    if (const auto wrong = static_frames_.take(transform, parameters_.input))
      rejections_.add(wrong->first, wrong->second);
  }
}

void StylusInput::on_transforms(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
  if (event.getPublisherName() == ros::this_node::getName()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  ++statistics_.messages;
  for (const geometry_msgs::TransformStamped& transform : event.getMessage()->transforms) {
    if (statistics_.frames.size() < max_named_frames) statistics_.frames.insert(frame(transform.child_frame_id));
    if (frame(transform.child_frame_id) != frame_) continue;
    if (!ros::Time::isSimTime()) {
      if (is_followed(event.getPublisherName())) on_wall_time(transform);
    } else if (const std::optional<ros::Time> now =
                   clock_.moment_of(transform.header.stamp, poses_, parameters_.max_age)) {
      if (is_followed(event.getPublisherName())) on_simulated_time(transform, *now);
    } else {
      early_poses_.keep(transform);
      restart_when_due();
    }
  }
}

bool StylusInput::is_followed(const std::string& sender) {
  const bool another = sender != sender_.name();
  if (!sender_.accepts(sender, ros_common::local_time().running)) {
    statistics_.other_sender = sender;
    rejections_.add(another_sender, "tf: " + frame_ + ": sent by " + sender + ", too, but " + sender_.name() +
                                        " is followed: stop one of them");
    return false;
  }
  if (another) wall_poses_.restart();
  statistics_.sender = sender;
  return true;
}

void StylusInput::on_wall_time(const geometry_msgs::TransformStamped& transform) {
  const std::size_t steps = wall_poses_.clock().steps();
  wall_poses_.offer(
      transform, ros_common::nanoseconds_of(transform.header.stamp), ros_common::wall_moment(),
      [&](const geometry_msgs::TransformStamped& one, std::int64_t stamp, double age) { use(one, stamp, age); },
      [&](const geometry_msgs::TransformStamped& one, motion::StampResult result, double age) {
        if (result == motion::StampResult::held_up) return rejections_.count(motion::to_string(result));
        reject_stamp(one, result, age);
      });
  if (const double host_set = wall_poses_.take_host_steps(); host_set != 0.0)
    ROS_WARN("this host's clock was set, or the host was suspended: compensating for an offset of %.3g s", host_set);
  if (wall_poses_.clock().steps() == steps) return;
  ++statistics_.clock_steps;
  ROS_WARN_STREAM("the clock of " << sender_.name() << " jumped: its stamps are used with a new offset from now on");
}

void StylusInput::on_simulated_time(const geometry_msgs::TransformStamped& transform, const ros::Time& now) {
  const double age = (now - transform.header.stamp).toSec();
  if ((poses_.newest - transform.header.stamp).toSec() > SimulatedClock::slip) early_poses_.keep(transform);
  using motion::StampResult;
  if (std::abs(age) > parameters_.max_age)
    return reject_stamp(transform, age > 0.0 ? StampResult::too_old : StampResult::from_the_future, age);
  if (use(transform, ros_common::nanoseconds_of(transform.header.stamp), age)) {
    advance_stream(transform.header.stamp, poses_, early_poses_);
  }
}

/// Queues a transform; returns whether it was used. `stamp`: its stamp in local time [ns].
bool StylusInput::use(const geometry_msgs::TransformStamped& transform, std::int64_t stamp, double age) {
  statistics_.newest_offer_age = age;
  const std::string& parent = transform.header.frame_id;
  const std::optional<RigidTransform> X_WP = static_frames_.in_world(parent);
  if (!X_WP) {
    const std::string rule = parameters_.world_frame + ", or a frame tied to it on /tf_static";
    rejections_.add("unknown frame",
                    place_of(transform) + validation::invalid_value("", "frame_id", frame(parent), rule));
    return false;
  }
  if (events_.is_full()) {
    rejections_.add_loop_stalled(place_of(transform));
    return false;
  }
  const hand_input::RawSample sample = raw_sample(transform.transform, seconds(stamp));
  events_.put(live::StylusPose{sample, parent, *X_WP, ros_common::local_time(), age});
  wake_();
  return true;
}

void StylusInput::reject_stamp(const geometry_msgs::TransformStamped& transform, motion::StampResult result,
                               double age) {
  statistics_.newest_offer_age = age;
  rejections_.add(motion::to_string(result), place_of(transform) + motion::complaint(result, age, parameters_.max_age));
}

void StylusInput::count_rejected(const std::vector<live::RejectedPose>& poses) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [result, pose] : poses) {
    rejections_.add(hand_input::to_string(result),
                    place(pose.parent, frame_) + hand_input::complaint(result, pose.sample, parameters_.input));
  }
}

void StylusInput::on_joy(const sensor_msgs::JoyConstPtr& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  // Without a clock the message has no time: an epoch that it starts would soon be replaced by the true one.
  if (ros::Time::now().isZero()) return rejections_.add("no clock", joy_ + ": no time on /clock yet");
  if (message->buttons.empty()) return rejections_.add("no buttons", joy_ + ": buttons: expected at least one button");
  if (events_.is_full()) return rejections_.add_loop_stalled(joy_ + ": ");
  const std::int64_t stamp = ros_common::nanoseconds_of(message->header.stamp);
  if (!ros::Time::isSimTime())
    return on_buttons(*message, wall_buttons_.local_or_now(stamp, ros_common::wall_moment()));
  if (const std::optional<ros::Time> now = clock_.moment_of(message->header.stamp, buttons_, parameters_.max_age))
    return on_simulated_time(*message, *now);
  early_buttons_.keep(*message);
  restart_when_due();
}

void StylusInput::on_simulated_time(const sensor_msgs::Joy& message, const ros::Time& now) {
  const ros::Time& stamp = message.header.stamp;
  if (!stamp.isZero() && (buttons_.newest - stamp).toSec() > SimulatedClock::slip) return early_buttons_.keep(message);
  const bool usable_stamp = std::abs((now - stamp).toSec()) <= parameters_.max_age;
  if (usable_stamp) advance_stream(stamp, buttons_, early_buttons_);
  on_buttons(message, ros_common::nanoseconds_of(usable_stamp ? stamp : now));
}

/// Queues button events. `stamp`: stamp of the message in local time [ns].
void StylusInput::on_buttons(const sensor_msgs::Joy& message, std::int64_t stamp) {
  const double t = seconds(stamp);
  using motion::ButtonEdge;
  const auto note = [&](std::size_t button, bool& was, ButtonEdge down, std::optional<ButtonEdge> up) {
    const bool is = message.buttons.size() > button && message.buttons[button] != 0;
    if (std::exchange(was, is) != is && (is || up)) events_.put(live::StylusButton{t, is ? down : *up});
  };
  note(0, pressed_, ButtonEdge::grasp, ButtonEdge::release);
  note(1, next_tool_, ButtonEdge::next_tool, std::nullopt);
  note(static_cast<std::size_t>(parameters_.simulation.clutch_button), clutch_, ButtonEdge::clutch_on,
       ButtonEdge::clutch_off);
  events_.put(live::ButtonsKnown{t, ros_common::local_time()});
  wake_();
}

/// Advances a stream to this stamp, and drops its kept messages: they were out of order, not from after a time jump.
template <typename Message>
void StylusInput::advance_stream(const ros::Time& stamp, SimulatedClock::Stream& stream,
                                 EarlyMessages<Message>& early) {
  if (stamp <= stream.newest) return;
  stream.newest = stamp;
  early.clear();
}

/// Restarts, unless an active stream has not reached the time jump yet.
void StylusInput::restart_when_due() {
  const bool poses_awaited = !poses_.newest.isZero() && early_poses_.empty();
  const bool buttons_awaited = !buttons_.newest.isZero() && early_buttons_.empty();
  if (clock_.is_waiting() && (poses_awaited || buttons_awaited)) return;
  const ros::Time now = ros::Time::now();
  ROS_INFO("time jumped back by %.3g s: the simulation restarts", clock_.restart());
  pressed_ = next_tool_ = clutch_ = false;
  zero_ = 0;
  poses_.newest = buttons_.newest = ros::Time();
  sender_.forget();
  ++statistics_.restarts;
  // The clock of a bag that is played fast may have advanced far: the kept messages get their original ages.
  const auto came_at = [&](const ros::Time& stamp) { return stamp.isZero() ? now : stamp; };
  for (const geometry_msgs::TransformStamped& transform : early_poses_.take()) {
    on_simulated_time(transform, came_at(transform.header.stamp));
  }
  for (const sensor_msgs::Joy& message : early_buttons_.take()) {
    on_simulated_time(message, came_at(message.header.stamp));
  }
}

/// Converts a moment of local time [ns] to seconds since the epoch.
double StylusInput::seconds(std::int64_t stamp) {
  if (zero_ == 0) {
    // In simulated time a whole second, so that a replayed bag gives bit-identical times, whatever arrives first.
    constexpr std::int64_t second = 1'000'000'000;
    zero_ = ros::Time::isSimTime() && stamp >= second ? stamp / second * second : stamp;
    events_.put(live::NewEpoch{zero_});
  }
  return ros::Duration().fromNSec(stamp - zero_).toSec();
}

}  // namespace spring_workbench::manipulation
