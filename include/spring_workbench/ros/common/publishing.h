#pragma once

#include <ros/publisher.h>
#include <std_msgs/Header.h>

#include <string>
#include <utility>

namespace spring_workbench::ros_common {

/// Suffix of a hand's topics and frames: "" for the first hand (0), "_2" for the second, and so on.
inline std::string hand_suffix(std::size_t hand) { return hand > 0 ? "_" + std::to_string(hand + 1) : ""; }

/// Publishes the message that `make` returns, with this header, if there is a subscriber.
template <typename Make>
void publish_made(const ros::Publisher& publisher, const std_msgs::Header& header, Make&& make) {
  if (publisher.getNumSubscribers() == 0) return;
  auto message = std::forward<Make>(make)();
  message.header = header;
  publisher.publish(message);
}

}  // namespace spring_workbench::ros_common
