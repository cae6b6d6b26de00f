#pragma once

#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>

#include <string>

#include "message_source.h"
#include "spring_workbench/motion/pose_follower.h"

namespace spring_workbench::tracker_driver {

/// A stylus dragged with the mouse in rviz: an interactive marker with six degrees of freedom under `stylus/marker`,
/// with grasping and the next tool in its menu, grasping also by the service `~grasp`.
class InteractiveMarkerSource : public MessageSource {
 public:
  /// `X_WB`: the stylus at the start, in the frame `workbench_frame`.
  InteractiveMarkerSource(ros::NodeHandle private_node, const std::string& workbench_frame, const RigidTransform& X_WB);
  motion::SourceHealth health() const override;

 private:
  using Feedback = visualization_msgs::InteractiveMarkerFeedbackConstPtr;

  void advance(double dt, motion::StationSample& sample) override;
  void make_menu();
  void on_feedback(const Feedback& feedback);
  void refuse_pose(const std::string& reason);
  void set_grasp(bool grasp);
  bool on_grasp(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);

  const std::string workbench_frame_;
  motion::PoseFollower follower_;
  interactive_markers::InteractiveMarkerServer server_;
  interactive_markers::MenuHandler menu_;
  interactive_markers::MenuHandler::EntryHandle grasp_entry_ = 0;
  ros::ServiceServer grasp_service_;
  bool grasp_ = false;
  double tool_button_for_ = 0.0;  ///< how much longer the button for the next tool is down [s]
  std::size_t drags_ = 0, left_out_ = 0;
};

}  // namespace spring_workbench::tracker_driver
