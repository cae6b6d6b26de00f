#include "spring_workbench/ros/common/lost_messages.h"

#include <cmath>
#include <utility>
#include <vector>

#include "spring_workbench/ros/common/counted_subscriber.h"
#include "spring_workbench/ros/common/diagnostic_status.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::ros_common {

diagnostic_msgs::DiagnosticStatus LostMessages::report(const std::string& name) {
  DiagnosticStatusBuilder status(name + ": messages lost", "queues");
  std::size_t lost = 0;
  for (const auto& [topic, count] : CountedSubscriber::lost()) {
    status.add(topic, count);
    lost += count;
  }
  if (lost > std::exchange(reported_, lost)) {
    status.warn("this node lost messages: its queue was full");
  }
  std::vector<std::string> slow;
  for (const auto& [connection, count] : unsent_.update()) {
    const long unsent = std::lround(count);
    if (unsent == 0) continue;
    status.add(connection, unsent);
    if (unsent > std::exchange(reported_unsent_[connection], unsent)) slow.push_back(connection);
  }
  if (!slow.empty())
    status.warn("messages were not sent, because the subscriber reads too slowly: " + validation::join(slow));
  return status.status();
}

}  // namespace spring_workbench::ros_common
