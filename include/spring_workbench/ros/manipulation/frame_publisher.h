#pragma once

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <atomic>
#include <string>
#include <vector>

#include "spring_workbench/live/view.h"

namespace spring_workbench::manipulation {

/// Publishes the displayed frames on /tf while another node subscribes: in each message the handle and tip of each tool
/// and the objects that have moved. The other objects take turns, so that each is sent ten times a second and a late
/// subscriber gets them all.
class FramePublisher {
 public:
  FramePublisher(ros::NodeHandle node, std::string world_frame, std::string frame_prefix);
  ~FramePublisher() { publisher_.shutdown(); }
  FramePublisher(const FramePublisher&) = delete;
  FramePublisher& operator=(const FramePublisher&) = delete;

  /// Publishes nothing for a zero stamp, and nothing twice for one stamp.
  void publish(const live::View& view, const ros::Time& stamp);

 private:
  void add_tools(const live::View& view);
  void add_objects(const live::View& view);
  void name_frames(const live::View& view);
  /// Number of objects at rest whose turn it is.
  std::size_t turns(std::size_t objects);

  std::string world_frame_, frame_prefix_;
  std::atomic<std::uint32_t> own_subscriptions_{0};  ///< subscriptions of this node itself to /tf
  ros::Publisher publisher_;
  boost::shared_ptr<tf2_msgs::TFMessage> message_;  ///< the message under construction
  ros::Time stamp_;
  std::shared_ptr<const scene::Scene> scene_;
  std::vector<geometry_msgs::TransformStamped> frames_;  ///< frames of this scene's objects, for the states in `sent_`
  std::vector<RigidTransform> X_OL_;  ///< poses of the objects' link frames, which are the published ones
  live::SharedStates sent_;
  std::size_t next_ = 0;                      ///< the object whose turn is next
  double turned_at_ = 0.0, turns_due_ = 0.0;  ///< time of the last turn [s, steady clock]; turns due, with a fraction
};

}  // namespace spring_workbench::manipulation
