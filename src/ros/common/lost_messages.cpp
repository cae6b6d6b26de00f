#include "spring_workbench/ros/common/lost_messages.h"

#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <optional>

#include "constants.h"
#include "spring_workbench/ros/common/diagnostic_status.h"

namespace spring_workbench::ros_common {
namespace {

/// Nothing while the node ends: its port still accepts calls, but no thread responds to them any more.
std::optional<XmlRpc::XmlRpcValue> bus_statistics(const std::string& name) {
  XmlRpc::XmlRpcValue caller, answer;
  caller[0] = name;
  XmlRpc::XmlRpcClient own_api("localhost", static_cast<int>(ros::XMLRPCManager::instance()->getServerPort()), "/");
  if (!own_api.executeNonBlock("getBusStats", caller)) return std::nullopt;
  XmlRpc::XmlRpcDispatch line;
  line.addSource(&own_api, XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  line.work(own_api_patience);  // until the answer is there, at most
  line.removeSource(&own_api);
  const bool done = own_api.executeCheckDone(answer) && !own_api.isFault();
  if (!done || answer.getType() != XmlRpc::XmlRpcValue::TypeArray || answer.size() < 2) return std::nullopt;
  return answer;
}

}  // namespace

/// roscpp counts them itself, and reports the counts of present connections only through the node's own API:
/// of publishers, subscribers [topic, [number, bytes, messages, lost, …] of each connection], services.
diagnostic_msgs::DiagnosticStatus LostMessages::report(const std::string& name) {
  std::optional<XmlRpc::XmlRpcValue> answer = bus_statistics(name);
  XmlRpc::XmlRpcValue none;
  none.setSize(0);
  XmlRpc::XmlRpcValue& subscribers = answer ? (*answer)[1] : none;
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
