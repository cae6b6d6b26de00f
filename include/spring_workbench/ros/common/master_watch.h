#pragma once

#include <ros/ros.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace spring_workbench::ros_common {

/// Keeps this process known to the ROS master. roscpp registers topics and services once, with the master that is there
/// at the time, and a restarted master knows nothing of them. This looks once a second and registers again: parameters,
/// publishers and services at once, subscribers `subscribers_later` looks after them, when the publishers of all nodes
/// with a MasterWatch are registered: roscpp drops its connection to a publisher that the master does not list.
/// Connections that exist stay, also those to nodes that do not register again.
class MasterWatch {
 public:
  /// What the master reported last.
  struct Answer {
    double received = 0.0;                                       ///< when [s], by the steady clock
    std::map<std::string, std::vector<std::string>> publishers;  ///< names of nodes by topic
  };

  /// `node`: has the queue of a thread that may wait for the master. In it, `on_new_master` is called after a restarted
  /// master was given the parameters in this node's namespace, as they were when this was made.
  explicit MasterWatch(
      const ros::NodeHandle& node, std::function<void()> on_new_master = [] {});

  /// Never null. Before the first answer it is empty, and received at the start.
  std::shared_ptr<const Answer> answer() const;

 private:
  void look();
  void learn_types();
  void register_with_new_master();
  bool register_subscribers() const;

  const std::function<void()> on_new_master_;
  const std::string own_uri_, services_uri_;
  XmlRpc::XmlRpcValue parameters_;
  std::vector<std::string> services_;         ///< of this process
  std::map<std::string, std::string> types_;  ///< of its publishers' topics
  int subscribers_due_ = 0;                   ///< looks until they are registered again; 0: they are
  mutable std::mutex mutex_;
  std::shared_ptr<const Answer> answer_;
  ros::SteadyTimer timer_;
};

}  // namespace spring_workbench::ros_common
