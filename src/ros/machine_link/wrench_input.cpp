#include "spring_workbench/ros/machine_link/wrench_input.h"

#include <cmath>
#include <utility>

#include "constants.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/ros/common/diagnostic_status.h"
#include "spring_workbench/ros/common/loop_clock.h"
#include "spring_workbench/ros/common/publishing.h"
#include "spring_workbench/validation/input_error.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::machine_link {
namespace {

Vector3d vector_of(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

}  // namespace

WrenchInput::WrenchInput(const ros::NodeHandle& private_node, std::size_t styluses, const std::string& world_frame,
                         const std::string& frame_prefix, double max_age, std::function<void()> wake)
    : name_(private_node.getNamespace()),
      world_frame_(world_frame),
      max_age_(max_age),
      wake_(std::move(wake)),
      sensors_(styluses, {"", "", motion::StreamClock(max_age), live::Inbox<live::StylusWrench>(max_waiting), {}}) {
  for (std::size_t hand = 0; hand < sensors_.size(); ++hand) {
    Sensor& sensor = sensors_[hand];
    sensor.topic = private_node.resolveName("external_wrench" + ros_common::hand_suffix(hand));
    sensor.tip_frame = frame_prefix + "fork_tip" + ros_common::hand_suffix(hand);
    sensor.subscriber = ros_common::CountedSubscriber::to<const geometry_msgs::WrenchStampedConstPtr&>(
        private_node, sensor.topic, input_queue, [this, &sensor](const auto& message) { on_wrench(sensor, *message); });
  }
}

void WrenchInput::add_to(live::HandEvents& events) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (std::size_t hand = 0; hand < sensors_.size(); ++hand) {
    for (const live::StylusWrench& wrench : sensors_[hand].came.take()) events[hand].emplace_back(wrench);
  }
}

/// The local time of a stamp if it is close to the current time, otherwise the current time [ns].
std::int64_t WrenchInput::local_stamp(Sensor& sensor, const ros::Time& stamp) const {
  if (!ros::Time::isSimTime())
    return sensor.clock.local_or_now(ros_common::nanoseconds_of(stamp), ros_common::wall_moment());
  const ros::Time now = ros::Time::now();
  return ros_common::nanoseconds_of(std::abs((now - stamp).toSec()) <= max_age_ ? stamp : now);
}

void WrenchInput::on_wrench(Sensor& sensor, const geometry_msgs::WrenchStamped& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++messages_;
  if (ros::Time::now().isZero()) return rejections_.add("no clock", sensor.topic + ": no time on /clock yet");
  const std::string& frame = message.header.frame_id;
  live::StylusWrench event;
  event.sample.wrench = {vector_of(message.wrench.force), vector_of(message.wrench.torque)};
  event.sample.axes =
      frame == sensor.tip_frame ? motion::ExternalWrench::Axes::tip : motion::ExternalWrench::Axes::world;
  try {
    if (frame != sensor.tip_frame && frame != world_frame_) {
      validation::refuse(sensor.topic, "header.frame_id", frame, world_frame_ + " or " + sensor.tip_frame);
    }
  } catch (const validation::InputError& error) {
    return rejections_.add("unknown frame", error.what());
  }
  try {
    motion::validate(event.sample, sensor.topic);
  } catch (const validation::InputError& error) {
    return rejections_.add("invalid value", error.what());
  }
  if (sensor.came.is_full()) return rejections_.add_loop_stalled(sensor.topic + ": ");
  event.stamp = local_stamp(sensor, message.header.stamp);
  sensor.came.put(event);
  wake_();
}

void WrenchInput::report(int timeouts, std::vector<diagnostic_msgs::DiagnosticStatus>& statuses) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (messages_ == 0 && timeouts == 0) return;
  ros_common::DiagnosticStatusBuilder status(name_ + ": external wrench", "force sensor");
  status.add("messages", messages_).add("timeouts", timeouts);
  std::size_t rejected = 0;
  for (const auto& [reason, count] : rejections_.counts()) {
    status.add("rejected: " + reason, count);
    rejected += count;
  }
  if (timeouts > std::exchange(reported_timeouts_, timeouts)) {
    status.warn("no external wrench arrived in time, so it was set to zero");
  }
  if (const std::size_t before = std::exchange(reported_rejected_, rejected); rejected > before) {
    status.warn(ros_common::increase("external wrenches rejected", before, rejected));
  }
  statuses.push_back(status.status());
}

}  // namespace spring_workbench::machine_link
