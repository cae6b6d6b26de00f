#pragma once

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <atomic>
#include <string>
#include <vector>

#include "spring_workbench/live/view.h"

namespace spring_workbench::manipulation {

/// Sends /tf of what is shown, while another node listens: each time handle and tip of each tool and the objects that
/// have moved, and of all others in turn as many as it takes for each to be sent ten times a second, so that who comes
/// late has them all.
class FramePublisher {
 public:
  FramePublisher(ros::NodeHandle node, std::string world_frame, std::string frame_prefix);
  ~FramePublisher() { publisher_.shutdown(); }
  FramePublisher(const FramePublisher&) = delete;
  FramePublisher& operator=(const FramePublisher&) = delete;

  /// Nothing is sent twice for one stamp, and nothing without one.
  void publish(const live::View& view, const ros::Time& stamp);

 private:
  void add_tools(const live::View& view);
  void add_objects(const live::View& view);
  void name_frames(const live::View& view);
  /// How many objects' turn it is.
  std::size_t turns(std::size_t objects);

  std::string world_frame_, frame_prefix_;
  std::atomic<std::uint32_t> own_subscriptions_{0};  ///< of this node, which takes /tf of others
  ros::Publisher publisher_;
  boost::shared_ptr<tf2_msgs::TFMessage> message_;  ///< that is being made
  ros::Time stamp_;
  std::shared_ptr<const scene::Scene> scene_;
  std::vector<geometry_msgs::TransformStamped> frames_;  ///< of the objects of this scene, as they are in `sent_`
  std::vector<RigidTransform> X_OL_;                     ///< of their frames, which are those of their links
  live::SharedStates sent_;
  std::size_t next_ = 0;                      ///< object in turn
  double turned_at_ = 0.0, turns_due_ = 0.0;  ///< [s], by the steady clock; with the fraction of a turn that is left
};

}  // namespace spring_workbench::manipulation
