#pragma once

#include <ros/node_handle.h>

#include <boost/make_shared.hpp>
#include <boost/weak_ptr.hpp>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace spring_workbench::ros_common {

/// Keeps work that may have to wait for the ROS master, so that nobody waits for it before the program exits. To be
/// called from one thread.
void leave_until_exit(std::future<void> work);

/// Runs work that may have to wait for the ROS master in the background, each after the one before, so that nobody
/// waits for it before the program exits. To be called from one thread.
void run_in_order(std::function<void()> work);

/// The subscribers of a part of a window, whose callbacks run in the thread that destroys it. None runs after `end` or
/// the destructor. Nothing here waits for the ROS master: it is told in the background, in the order of the calls,
/// since roscpp loses a subscriber to a topic whose last one is ending.
class Subscriptions {
 public:
  Subscriptions() = default;
  ~Subscriptions() { end(); }
  Subscriptions(const Subscriptions&) = delete;
  Subscriptions& operator=(const Subscriptions&) = delete;

  /// Throws ros::InvalidNameException.
  template <class Message>
  void add(const ros::NodeHandle& node, const std::string& topic, std::uint32_t queue,
           std::function<void(const boost::shared_ptr<const Message>&)> callback) {
    const std::string name = node.resolveName(topic);
    run_in_order([=, of = subscribers_, node = node, not_ended = boost::weak_ptr<const void>(callbacks_)]() mutable {
      const ros::TransportHints at_once = ros::TransportHints().tcpNoDelay();
      const boost::shared_ptr<const void> callbacks = not_ended.lock();
      if (callbacks) of->push_back(node.subscribe<Message>(name, queue, callback, callbacks, at_once));
    });
  }
  void end();

 private:
  boost::shared_ptr<const void> callbacks_ = boost::make_shared<int>();  ///< without it they are not called
  std::shared_ptr<std::vector<ros::Subscriber>> subscribers_ = std::make_shared<std::vector<ros::Subscriber>>();
};

}  // namespace spring_workbench::ros_common
