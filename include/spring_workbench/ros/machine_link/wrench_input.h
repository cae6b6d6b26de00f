#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <geometry_msgs/WrenchStamped.h>
#include <ros/ros.h>

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "spring_workbench/live/inbox.h"
#include "spring_workbench/live/stylus_events.h"
#include "spring_workbench/motion/stream_clock.h"
#include "spring_workbench/ros/common/counted_subscriber.h"
#include "spring_workbench/ros/common/rejections.h"

namespace spring_workbench::machine_link {

/// Subscribes to `external_wrench`, `external_wrench_2`, …: measurements of machines' force sensors on the objects that
/// the styluses hold. Invalid messages are rejected, counted by reason and reported in one throttled line.
class WrenchInput {
 public:
  /// `styluses`: number of styluses; `world_frame`: frame of wrenches in world axes; `frame_prefix`: prefix of the tip
  /// frames; `max_age` [s]: a stamp further from now is replaced by the time of arrival. `wake` is called after each
  /// valid message.
  WrenchInput(const ros::NodeHandle& private_node, std::size_t styluses, const std::string& world_frame,
              const std::string& frame_prefix, double max_age, std::function<void()> wake);

  /// Adds the wrenches since the last call.
  void add_to(live::HandEvents& events);
  /// Adds a status of /diagnostics once a message has arrived; WARN if there was a timeout or a rejection since the
  /// last call. `timeouts`: number of times so far that the watchdog has set a wrench to zero.
  void report(int timeouts, std::vector<diagnostic_msgs::DiagnosticStatus>& statuses);

 private:
  struct Sensor {
    std::string topic, tip_frame;
    motion::StreamClock clock;
    live::Inbox<live::StylusWrench> came;
    ros_common::CountedSubscriber subscriber;
  };
  void on_wrench(Sensor& sensor, const geometry_msgs::WrenchStamped& message);
  std::int64_t local_stamp(Sensor& sensor, const ros::Time& stamp) const;

  const std::string name_, world_frame_;
  const double max_age_;
  const std::function<void()> wake_;
  std::mutex mutex_;
  std::size_t messages_ = 0;
  ros_common::Rejections rejections_;
  std::size_t reported_rejected_ = 0;
  int reported_timeouts_ = 0;
  std::vector<Sensor> sensors_;
};

}  // namespace spring_workbench::machine_link
