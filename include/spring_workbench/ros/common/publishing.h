#pragma once

#include <ros/publisher.h>
#include <std_msgs/Header.h>

#include <string>
#include <utility>

namespace spring_workbench::ros_common {

/// What the topics and frames of a hand end in: "" of the first (0), "_2" of the second, and so on.
inline std::string hand_suffix(std::size_t hand) { return hand > 0 ? "_" + std::to_string(hand + 1) : ""; }

/// Sends what `make` makes, with this header, if somebody listens.
template <typename Make>
void publish_made(const ros::Publisher& publisher, const std_msgs::Header& header, Make&& make) {
  if (publisher.getNumSubscribers() == 0) return;
  auto message = std::forward<Make>(make)();
  message.header = header;
  publisher.publish(message);
}

}  // namespace spring_workbench::ros_common
