#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "spring_workbench/ForkState.h"
#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/assembly/simulated_operator.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/ros/common/publishing.h"
#include "spring_workbench/tools/tool.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::tracker_driver {

/// What the simulated operator perceives of a running node `manipulation`: its ~objects, and the ~fork of each hand.
class OperatorEyes {
 public:
  OperatorEyes(ros::NodeHandle node, std::size_t hands)
      : objects_subscriber_(node.subscribe("manipulation/objects", 1, &OperatorEyes::on_objects, this)) {
    view_.tools.resize(hands);
    for (std::size_t hand = 0; hand < hands; ++hand) {
      fork_subscribers_.push_back(node.subscribe<ForkState>(
          "manipulation/fork" + ros_common::hand_suffix(hand), 1,
          [this, hand](const ForkState::ConstPtr& message) { view_.tools[hand] = tool_of(*message); }));
    }
  }

  /// Waits for the first messages, or until shutdown. The forks of further hands are published once these move; until
  /// then the first hand's fork is used for them.
  void wait() {
    while (ros::ok() && (view_.objects.empty() || view_.tools.front().X_HE.translation().isZero())) {
      ros::spinOnce();
      ros::WallDuration(0.02).sleep();
    }
    for (assembly::OperatorView::Tool& tool : view_.tools) {
      if (tool.X_HE.translation().isZero()) tool = view_.tools.front();
    }
  }
  /// Runs the pending callbacks of this thread and returns the newest view.
  assembly::OperatorView look() {
    ros::spinOnce();
    return view_;
  }

 private:
  void on_objects(const ObjectStates& message) {
    view_.objects.clear();
    for (const ObjectState& object : message.objects) {
      const auto& v = object.twist.linear;
      bodies::BodyState state;
      state.name = object.name;
      state.X_WO = ros_common::from_message(object.pose);
      state.V_WO_W.linear = Vector3d(v.x, v.y, v.z);
      state.held = object.held != 0;
      state.highlighted = object.highlighted != 0;
      state.in_contact = object.in_contact != 0;
      state.asleep = object.asleep != 0;
      view_.objects.push_back(state);
    }
  }
  static assembly::OperatorView::Tool tool_of(const ForkState& message) {
    assembly::OperatorView::Tool tool;
    tool.X_HE.translation().z() = message.length;
    tool.turns = tools::turns_object(validation::named<tools::Tool>(message.tool, "fork", "tool"));
    tool.held_object = message.held_object;
    return tool;
  }

  assembly::OperatorView view_;
  ros::Subscriber objects_subscriber_;
  std::vector<ros::Subscriber> fork_subscribers_;
};

}  // namespace spring_workbench::tracker_driver
