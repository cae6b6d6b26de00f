#pragma once

#include <ros/node_handle.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <future>
#include <string>
#include <vector>

namespace spring_workbench::ros_common {

/// Keeps work that may have to wait for the ROS master, so that nobody waits for it before the program exits. To be
/// called from one thread.
void leave_until_exit(std::future<void> work);

/// The subscribers of a part of a window, whose callbacks run in the thread that destroys it. None runs after `end` or
/// the destructor, which do not wait for the ROS master: it is told in the background.
class Subscriptions {
 public:
  Subscriptions() = default;
  ~Subscriptions() { end(); }
  Subscriptions(const Subscriptions&) = delete;
  Subscriptions& operator=(const Subscriptions&) = delete;

  template <class Message>
  void add(ros::NodeHandle& node, const std::string& topic, std::uint32_t queue,
           std::function<void(const boost::shared_ptr<const Message>&)> callback) {
    const ros::TransportHints at_once = ros::TransportHints().tcpNoDelay();
    subscribers_.push_back(node.subscribe<Message>(topic, queue, callback, callbacks_, at_once));
  }
  void end();
  /// The same, but waits for the master, so that the same topics can be subscribed to at once.
  void replace() { subscribers_.clear(); }

 private:
  boost::shared_ptr<const void> callbacks_ = boost::make_shared<int>();  ///< without it they are not called
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace spring_workbench::ros_common
