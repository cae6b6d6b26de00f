#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <string>

namespace spring_workbench::ros_common {

/// A queue of callbacks with a thread of its own, which nothing else keeps waiting.
class CallbackThread {
 public:
  /// `name`: of the thread, as `top -H` shows it; at most 15 characters.
  explicit CallbackThread(const std::string& name);
  /// Its callbacks come from the queue.
  ros::NodeHandle handle(ros::NodeHandle node) {
    node.setCallbackQueue(&queue_);
    return node;
  }
  /// Waits for the callback that runs; none runs after that.
  void stop() { spinner_.stop(); }

 private:
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
};

}  // namespace spring_workbench::ros_common
