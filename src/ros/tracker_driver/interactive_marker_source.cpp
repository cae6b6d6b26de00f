#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>

#include <cmath>

#include "constants.h"
#include "message_source.h"
#include "spring_workbench/math/moving_frames.h"
#include "spring_workbench/motion/pose_follower.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::tracker_driver {
namespace {

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::InteractiveMarkerFeedback;
using visualization_msgs::Marker;

const char* const marker_name = "stylus";

/// A ball around the handle that can be dragged in the image plane; with Shift towards and away from the viewer; with
/// Ctrl it rotates.
InteractiveMarkerControl make_ball() {
  Marker ball;
  ball.type = Marker::SPHERE;
  ball.scale.x = ball.scale.y = ball.scale.z = 0.06;
  ball.color.r = 0.95F;
  ball.color.g = 0.75F;
  ball.color.b = 0.2F;
  ball.color.a = 0.6F;
  ball.pose.orientation.w = 1.0;
  InteractiveMarkerControl control;
  control.name = "ball";
  control.description = "drag to move; Shift: away and back; Ctrl: rotate; right button: menu";
  control.interaction_mode = InteractiveMarkerControl::MOVE_ROTATE_3D;
  control.always_visible = true;
  control.orientation.w = 1.0;
  control.markers = {ball};
  return control;
}

/// Arrows along, or a ring about, one axis of the handle.
InteractiveMarkerControl make_axis(const std::string& name, const Vector3d& axis, std::uint8_t mode) {
  InteractiveMarkerControl control;
  control.name = name;
  control.interaction_mode = mode;
  control.orientation = ros_common::to_quaternion(math::shortest_rotation(Vector3d::UnitX(), axis));
  return control;
}

InteractiveMarker make_marker(const std::string& frame, const RigidTransform& X_WB) {
  InteractiveMarker marker;
  marker.header.frame_id = frame;
  marker.name = marker_name;
  marker.scale = 0.15F;
  marker.pose = ros_common::to_pose(X_WB);
  marker.controls = {make_ball()};
  const std::string names = "xyz";
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, names[static_cast<std::size_t>(i)]);
    marker.controls.push_back(make_axis("move " + axis, Vector3d::Unit(i), InteractiveMarkerControl::MOVE_AXIS));
    marker.controls.push_back(make_axis("turn " + axis, Vector3d::Unit(i), InteractiveMarkerControl::ROTATE_AXIS));
  }
  return marker;
}

bool is_pose(const geometry_msgs::Pose& pose) {
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return std::isfinite(p.x + p.y + p.z) && std::abs(norm - 1.0) < 0.1;
}

class InteractiveMarkerSource final : public MessageSource {
 public:
  InteractiveMarkerSource(ros::NodeHandle private_node, const std::string& workbench_frame, const RigidTransform& X_WB)
      : workbench_frame_(workbench_frame),
        follower_(X_WB),
        server_("stylus/marker"),
        grasp_service_(private_node.advertiseService("grasp", &InteractiveMarkerSource::on_grasp, this)) {
    server_.insert(make_marker(workbench_frame, X_WB), [this](const Feedback& feedback) { on_feedback(feedback); });
    make_menu();
  }

  motion::SourceHealth health() const override {
    return {true, "moved by the marker under stylus/marker", {{"drags", drags_}, {"poses rejected", rejected_}}};
  }

 private:
  using Feedback = visualization_msgs::InteractiveMarkerFeedbackConstPtr;

  const RigidTransform& advance(double dt, motion::StationSample& sample) override {
    sample.button = grasp_;
    sample.next_tool = tool_button_for_ > 0.0;
    tool_button_for_ -= dt;
    return follower_.advance(dt);
  }

  void make_menu() {
    using interactive_markers::MenuHandler;
    grasp_entry_ = menu_.insert("Grasp", [this](const Feedback&) { set_grasp(!grasp_); });
    menu_.setCheckState(grasp_entry_, MenuHandler::UNCHECKED);
    menu_.insert("Next tool", [this](const Feedback&) { tool_button_for_ = menu_press; });
    menu_.apply(server_, marker_name);
    server_.applyChanges();
  }

  void on_feedback(const Feedback& feedback) {
    if (feedback->event_type != InteractiveMarkerFeedback::POSE_UPDATE) return;
    if (feedback->header.frame_id != workbench_frame_) {
      return refuse_pose(validation::invalid_value("", "frame_id", feedback->header.frame_id, workbench_frame_));
    }
    if (!is_pose(feedback->pose)) return refuse_pose("pose: expected a finite pose with a quaternion of length 1");
    follower_.set_goal(ros_common::from_message(feedback->pose));
    ++drags_;
  }

  void refuse_pose(const std::string& reason) {
    ++rejected_;
    ROS_WARN_STREAM_THROTTLE(5.0, "rejected: stylus/marker/feedback: " << reason);
    server_.setPose(marker_name, ros_common::to_pose(follower_.goal()));
    server_.applyChanges();
  }

  void set_grasp(bool grasp) {
    using interactive_markers::MenuHandler;
    grasp_ = grasp;
    menu_.setCheckState(grasp_entry_, grasp ? MenuHandler::CHECKED : MenuHandler::UNCHECKED);
    menu_.reApply(server_);
    server_.applyChanges();
  }

  bool on_grasp(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    set_grasp(request.data != 0);
    response.success = true;
    response.message = grasp_ ? "the grasp button is down" : "the grasp button is up";
    return true;
  }

  const std::string workbench_frame_;
  motion::PoseFollower follower_;
  interactive_markers::InteractiveMarkerServer server_;
  interactive_markers::MenuHandler menu_;
  interactive_markers::MenuHandler::EntryHandle grasp_entry_ = 0;
  ros::ServiceServer grasp_service_;
  bool grasp_ = false;
  double tool_button_for_ = 0.0;  ///< remaining time that the button for the next tool is down [s]
  std::size_t drags_ = 0, rejected_ = 0;
};

}  // namespace

std::unique_ptr<motion::LiveSource> make_interactive_marker_source(const ros::NodeHandle& private_node,
                                                                   const std::string& workbench_frame,
                                                                   const RigidTransform& X_WB) {
  return std::make_unique<InteractiveMarkerSource>(private_node, workbench_frame, X_WB);
}

}  // namespace spring_workbench::tracker_driver
