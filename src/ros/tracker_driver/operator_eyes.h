#pragma once

#include <ros/ros.h>

#include "spring_workbench/ForkState.h"
#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/assembly/simulated_operator.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/tools/tool.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::tracker_driver {

/// What the simulated operator sees of a running node `manipulation`: its ~objects and ~fork.
class OperatorEyes {
 public:
  explicit OperatorEyes(ros::NodeHandle node)
      : objects_subscriber_(node.subscribe("manipulation/objects", 1, &OperatorEyes::on_objects, this)),
        fork_subscriber_(node.subscribe("manipulation/fork", 1, &OperatorEyes::on_fork, this)) {}

  /// Waits until something is seen; returns at shutdown too.
  void wait() {
    while (ros::ok() && (view_.objects.empty() || view_.X_HE.translation().isZero())) {
      ros::spinOnce();
      ros::WallDuration(0.02).sleep();
    }
  }
  /// The newest view; serves the callbacks of this thread first.
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
  void on_fork(const ForkState& message) {
    view_.X_HE.translation().z() = message.length;
    view_.turns = tools::turns(validation::named<tools::Tool>(message.tool, "fork", "tool"));
  }

  assembly::OperatorView view_;
  ros::Subscriber objects_subscriber_, fork_subscriber_;
};

}  // namespace spring_workbench::tracker_driver
