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

/// Takes over work that may be waiting for the ROS master, so that nothing waits for it until the program exits. To be
/// called from one thread.
void leave_until_exit(std::future<void> work);

/// Runs work that may have to wait for the ROS master in the background, in the order of the calls, so that nothing
/// waits for it until the program exits. To be called from one thread.
void run_in_order(std::function<void()> work);

/// The ROS subscribers of one component of a window. Their callbacks run in the thread that destroys this object; none
/// runs after `end` or the destructor. Nothing here waits for the ROS master: subscriptions are made and ended in the
/// background, in the order of the calls, because roscpp can lose a new subscriber to a topic whose last one is ending.
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
