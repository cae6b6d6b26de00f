#pragma once

#include <ros/ros.h>

#include <boost/function.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace spring_workbench::ros_common {

/// A subscriber that counts the messages it loses because its queue is full when they arrive, whoever sent them.
class CountedSubscriber {
 public:
  class Counter;

  CountedSubscriber() = default;
  /// Subscribes to `topic` with a queue of `queue` messages and without delays by TCP. The callback runs in the
  /// callback queue of `node`. `Parameter`: parameter type of the callback, as in roscpp.
  template <class Parameter>
  static CountedSubscriber to(ros::NodeHandle node, const std::string& topic, std::uint32_t queue,
                              const boost::function<void(Parameter)>& callback) {
    ros::SubscribeOptions options;
    options.initByFullCallbackType<Parameter>(topic, queue, callback);
    return CountedSubscriber(node, options);
  }
  std::string topic() const { return subscriber_.getTopic(); }

  /// Number of messages that this process has lost so far, by topic. If a topic has several counted subscribers (each
  /// hand has one for /tf), the largest of their counts.
  static std::map<std::string, std::size_t> lost();

 private:
  CountedSubscriber(ros::NodeHandle& node, ros::SubscribeOptions options);

  std::shared_ptr<Counter> counter_;  ///< must outlive the subscribers
  ros::Subscriber subscriber_, arrivals_;
};

}  // namespace spring_workbench::ros_common
