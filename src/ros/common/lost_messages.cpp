#include "spring_workbench/ros/common/lost_messages.h"

#include <utility>

#include "spring_workbench/ros/common/counted_subscriber.h"
#include "spring_workbench/ros/common/diagnostic_status.h"

namespace spring_workbench::ros_common {

diagnostic_msgs::DiagnosticStatus LostMessages::report(const std::string& name) {
  DiagnosticStatusBuilder status(name + ": messages lost", "queues of subscribers");
  std::size_t lost = 0;
  for (const auto& [topic, count] : CountedSubscriber::lost()) {
    status.add(topic, count);
    lost += count;
  }
  if (lost > std::exchange(reported_, lost)) {
    status.warn("messages were lost: a subscriber's queue was full");
  }
  return status.status();
}

}  // namespace spring_workbench::ros_common
