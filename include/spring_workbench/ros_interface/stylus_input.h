#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "spring_workbench/motion/pose_track.h"
#include "spring_workbench/ros_interface/parameters.h"

namespace spring_workbench {

/// The input starts anew: all times that follow count from `zero`.
struct NewEpoch {
  ros::Time zero;
};
/// A pose of the handle in world; `arrival` is the local time (see `loop_time`) at which it came.
struct StylusPose {
  PoseSample sample;
  double arrival = 0.0;
};
/// The grasp button went down or up at time `t` [s].
struct StylusButton {
  double t = 0.0;
  bool pressed = false;
};
using StylusEvent = std::variant<NewEpoch, StylusPose, StylusButton>;

/// What came in so far.
struct InputStatistics {
  std::size_t samples = 0;                      ///< used
  std::size_t dropouts = 0;                     ///< gaps longer than `dropout_after`
  std::size_t restarts = 0;                     ///< times ROS time jumped back
  std::map<std::string, std::size_t> left_out;  ///< by reason
  double interval = 0.0;                        ///< between the newest two samples [s]
  double age = 0.0;                             ///< of the newest sample when it came, by its stamp [s]
  double newest_arrival = 0.0;                  ///< local time [s]
};

/// Why a transform from outside cannot be used: reason and one line for the log. Empty when it can.
struct TransformFault {
  std::string reason;
  std::string line;
};
std::optional<TransformFault> find_fault(const geometry_msgs::TransformStamped& transform);

/// Listens to /tf, /tf_static and stylus/joy, and keeps what came, in order, until it is taken. What cannot be used is
/// left out, counted by reason and told in one throttled line.
class StylusInput {
 public:
  StylusInput(ros::NodeHandle node, const ManipulationParameters& parameters);

  /// What came since the last call. The first event ever, and the first after a jump of time, is a NewEpoch.
  std::vector<StylusEvent> take_events();
  InputStatistics statistics() const;
  /// Whether /tf_static said where the workbench is.
  bool workbench_known() const;

 private:
  void on_transforms(const tf2_msgs::TFMessageConstPtr& message);
  void on_static_transforms(const tf2_msgs::TFMessageConstPtr& message);
  void on_joy(const sensor_msgs::JoyConstPtr& message);
  void on_stylus(const geometry_msgs::TransformStamped& transform, const ros::Time& now);
  void notice_jump(const ros::Time& now);
  double seconds(const ros::Time& stamp);
  void leave_out(const std::string& reason, const std::string& line);

  const ManipulationParameters parameters_;
  mutable std::mutex mutex_;
  tf2::BufferCore static_frames_;
  bool workbench_known_ = false;
  std::vector<StylusEvent> events_;
  InputStatistics statistics_;
  std::map<std::string, ros::WallTime> told_;  ///< when a reason to leave a sample out was last logged
  ros::Time zero_;                             ///< of the epoch; zero before the first input
  ros::Time newest_;                           ///< stamp of the newest sample of the epoch; zero before it
  ros::Time last_now_;
  bool pressed_ = false;
  ros::Subscriber tf_subscriber_, static_subscriber_, joy_subscriber_;
};

}  // namespace spring_workbench
