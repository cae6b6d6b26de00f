#include "spring_workbench/ros/markers/marker_publisher.h"

#include <algorithm>

#include "constants.h"

namespace spring_workbench::markers {

MarkerPublisher::MarkerPublisher(ros::NodeHandle private_node, const std::string& fork_curve, double fork_diameter,
                                 double rate)
    : period_(1.0 / rate),
      all_(fork_curve, fork_diameter, std::max(shortest_marker_lifetime, 3.0 / rate)),
      display_markers_(fork_curve, fork_diameter, std::max(shortest_marker_lifetime, 3.0 / rate),
                       Drawn::not_in_displays),
      all_publisher_(private_node.advertise<visualization_msgs::MarkerArray>("markers", 5)),
      display_publisher_(private_node.advertise<visualization_msgs::MarkerArray>("display/markers", 5)) {}

bool MarkerPublisher::publish(const live::View& view, const std_msgs::Header& header, double now) {
  const bool wait = now < next_ && now > next_ - period_;  // no wait if the clock jumped back
  const bool all = all_publisher_.getNumSubscribers() > 0;
  const bool for_displays = display_publisher_.getNumSubscribers() > 0;
  if (wait || (!all && !for_displays)) return false;
  next_ = now < next_ + period_ && now >= next_ ? next_ + period_ : now + period_;
  if (all) all_publisher_.publish(all_.build(view, header));
  if (for_displays) display_publisher_.publish(display_markers_.build(view, header));
  return true;
}

}  // namespace spring_workbench::markers
