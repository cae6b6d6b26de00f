#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "spring_workbench/live/inbox.h"
#include "spring_workbench/live/stylus_events.h"
#include "spring_workbench/motion/stream_clock.h"
#include "spring_workbench/ros/common/counted_subscriber.h"
#include "spring_workbench/ros/common/early_messages.h"
#include "spring_workbench/ros/common/rejections.h"
#include "spring_workbench/ros/common/simulated_clock.h"
#include "spring_workbench/ros/manipulation/manipulation_parameters.h"
#include "spring_workbench/ros/manipulation/static_frames.h"

namespace spring_workbench::manipulation {

using ros_common::EarlyMessages;
using ros_common::SimulatedClock;

/// Statistics of the input so far.
struct InputStatistics {
  std::size_t messages = 0;      ///< messages on /tf, except those from this node
  std::set<std::string> frames;  ///< child frames in them
  std::size_t restarts = 0;      ///< number of times that simulated time jumped back
  std::size_t clock_steps = 0;   ///< number of times that the sender's clock was set
  std::string sender;            ///< the node whose stylus is followed; empty before the first message
  std::string other_sender;      ///< another node that sends the same stylus and is ignored; empty if there is none
  std::map<std::string, std::size_t> rejected;  ///< by reason
  double newest_offer_age = 0.0;  ///< age, by its stamp, of the newest sample, whether or not it was used [s]
};

/// Reason to reject messages of a second sender.
constexpr char another_sender[] = "another sender";

/// Input of one stylus: subscribes to /tf, /tf_static and its buttons, and queues the events until they are taken.
/// Unusable messages are rejected, counted by reason and logged in one throttled line. Poses are not filtered here; the
/// outlier gate is in the InputFilter.
class StylusInput {
 public:
  /// Subscribes to the child frame `stylus` and to `stylus/joy`, or to those of a further `hand` (button 0 grasps while
  /// it is down, button 1 selects the next tool). `wake` is called after each event.
  StylusInput(const ros::NodeHandle& node, const ManipulationParameters& parameters, std::size_t hand,
              std::function<void()> wake);

  /// Returns the events since the last call. The very first event, and the first after simulated time has jumped back,
  /// is a live::NewEpoch.
  std::vector<live::StylusEvent> take_events();
  /// Counts and logs the poses that the gate rejected.
  void count_rejected(const std::vector<live::RejectedPose>& poses);
  InputStatistics statistics() const;
  bool workbench_known() const;  ///< whether the pose of the workbench is known from /tf_static

 private:
  void on_transforms(const ros::MessageEvent<const tf2_msgs::TFMessage>& event);
  void on_static_transforms(const tf2_msgs::TFMessageConstPtr& message);
  void on_joy(const sensor_msgs::JoyConstPtr& message);
  bool is_followed(const std::string& sender);
  void on_wall_time(const geometry_msgs::TransformStamped& transform);
  void on_simulated_time(const geometry_msgs::TransformStamped& transform, const ros::Time& now);
  bool use(const geometry_msgs::TransformStamped& transform, std::int64_t stamp, double age);
  void on_simulated_time(const sensor_msgs::Joy& message, const ros::Time& now);
  void on_buttons(const sensor_msgs::Joy& message, std::int64_t stamp);
  template <typename Message>
  void advance_stream(const ros::Time& stamp, SimulatedClock::Stream& stream, EarlyMessages<Message>& early);
  void restart_when_due();
  double seconds(std::int64_t stamp);
  void reject_stamp(const geometry_msgs::TransformStamped& transform, motion::StampResult result, double age);

  const ManipulationParameters parameters_;
  const std::string frame_, joy_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  StaticFrames static_frames_;
  motion::SenderChoice sender_;
  motion::StampedStream<geometry_msgs::TransformStamped> wall_poses_;  ///< as the next, for wall time
  motion::StreamClock wall_buttons_;
  live::Inbox<live::StylusEvent> events_;
  InputStatistics statistics_;
  // For simulated time.
  EarlyMessages<geometry_msgs::TransformStamped> early_poses_;
  EarlyMessages<sensor_msgs::Joy> early_buttons_;
  SimulatedClock::Stream poses_, buttons_;
  SimulatedClock clock_;
  ros_common::Rejections rejections_;
  std::int64_t zero_ = 0;  ///< epoch in local time [ns]; 0 before the first input
  bool pressed_ = false, next_tool_ = false, clutch_ = false;
  ros_common::CountedSubscriber tf_subscriber_, static_subscriber_, joy_subscriber_;
};

}  // namespace spring_workbench::manipulation
