#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <string>

namespace spring_workbench::ros_common {

/// A callback queue with its own thread, so that its callbacks do not wait for others.
class CallbackThread {
 public:
  /// `name`: name of the thread, as shown by `top -H`; at most 15 characters.
  explicit CallbackThread(const std::string& name);
  /// Returns the node handle with this queue as its callback queue.
  ros::NodeHandle handle(ros::NodeHandle node) {
    node.setCallbackQueue(&queue_);
    return node;
  }
  /// Waits for the running callback; none runs afterwards.
  void stop() { spinner_.stop(); }

 private:
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
};

}  // namespace spring_workbench::ros_common
