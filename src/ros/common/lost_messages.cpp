#include "spring_workbench/ros/common/lost_messages.h"

#include <ros/ros.h>

#include <optional>

#include "own_api.h"
#include "spring_workbench/ros/common/diagnostic_status.h"

namespace spring_workbench::ros_common {

/// roscpp counts lost messages but reports the counts, for open connections, only through the node's own API:
/// publishers, subscribers [topic, [number, bytes, messages, lost, …] per connection], services.
diagnostic_msgs::DiagnosticStatus LostMessages::report(const std::string& name) {
  XmlRpc::XmlRpcValue caller;
  caller[0] = name;
  std::optional<XmlRpc::XmlRpcValue> answer = call_own_api("getBusStats", caller);
  XmlRpc::XmlRpcValue none;
  none.setSize(0);
  XmlRpc::XmlRpcValue& subscribers = answer && answer->size() > 1 ? (*answer)[1] : none;
  std::map<std::string, std::size_t> by_topic;
  bool more = false;
  for (int i = 0; i < subscribers.size(); ++i) {
    const std::string topic = subscribers[i][0];
    by_topic[topic] = 0;
    XmlRpc::XmlRpcValue& connections = subscribers[i][1];
    for (int k = 0; k < connections.size(); ++k) {
      std::size_t& known = lost_[{topic, static_cast<int>(connections[k][0])}];
      const auto now = static_cast<std::size_t>(static_cast<int>(connections[k][3]));
      more |= now > known;
      known = now;
    }
  }
  for (const auto& [connection, count] : lost_) by_topic[connection.first] += count;
  DiagnosticStatusBuilder status(name + ": messages lost", "queues of subscribers");
  for (const auto& [topic, count] : by_topic) status.add(topic, count);
  if (!answer) status.raise(diagnostic_msgs::DiagnosticStatus::WARN, "the node's own API does not answer");
  if (more) status.raise(diagnostic_msgs::DiagnosticStatus::WARN, "messages were lost: a subscriber's queue was full");
  return status.status();
}

}  // namespace spring_workbench::ros_common
