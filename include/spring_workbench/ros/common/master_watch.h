#pragma once

#include <ros/ros.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace spring_workbench::ros_common {

/// Keeps this process registered with the ROS master. roscpp registers topics and services only once, with the master
/// that is running at the time; a restarted master does not know them. This class checks once a second and registers
/// them again: parameters, publishers and services at once, subscribers `subscribers_later` checks later, when the
/// publishers of all nodes with a MasterWatch are registered, because roscpp drops its connection to a publisher that
/// the master does not list. Existing connections are kept, even to nodes that do not register again.
class MasterWatch {
 public:
  /// The newest report of the master.
  struct Answer {
    double received = 0.0;                                       ///< when [s], by the steady clock
    std::map<std::string, std::vector<std::string>> publishers;  ///< names of nodes by topic
  };

  /// `node`: its callback queue belongs to a thread that may wait for the master. `on_new_master` is called in that
  /// thread once a restarted master has received the parameters in this node's namespace, as they were when this object
  /// was made.
  explicit MasterWatch(
      const ros::NodeHandle& node, std::function<void()> on_new_master = [] {});

  /// Never null. Until the master has answered, it is empty and counts as received at the start.
  std::shared_ptr<const Answer> answer() const;

 private:
  void look();
  void learn_types();
  void register_with_new_master();
  bool register_subscribers() const;

  const std::function<void()> on_new_master_;
  const std::string own_uri_, services_uri_;
  XmlRpc::XmlRpcValue parameters_;
  std::vector<std::string> services_;         ///< services of this process
  std::map<std::string, std::string> types_;  ///< types of its publishers' topics
  int subscribers_due_ = 0;                   ///< checks left until they are registered again; 0: none
  mutable std::mutex mutex_;
  std::shared_ptr<const Answer> answer_;
  ros::SteadyTimer timer_;
};

}  // namespace spring_workbench::ros_common
