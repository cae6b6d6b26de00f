#pragma once

#include <ros/ros.h>

#include "spring_workbench/ForkState.h"
#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/assembly/simulated_operator.h"

namespace spring_workbench::tracker_driver {

/// What the simulated operator sees of a running node `manipulation`: its ~objects and ~fork.
class OperatorEyes {
 public:
  explicit OperatorEyes(ros::NodeHandle node);

  /// Waits until something is seen; returns at shutdown too.
  void wait();
  /// The newest view; serves the callbacks of this thread first.
  assembly::OperatorView look();

 private:
  void on_objects(const ObjectStates& message);
  void on_fork(const ForkState& message);

  assembly::OperatorView view_;
  ros::Subscriber objects_subscriber_, fork_subscriber_;
};

}  // namespace spring_workbench::tracker_driver
