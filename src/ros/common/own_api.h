#pragma once

#include <ros/ros.h>

#include <optional>
#include <string>

namespace spring_workbench::ros_common {

/// Calls this node's own XML-RPC API (ROS slave API); `arguments` begin with the caller's name. Returns the response:
/// code, message and payload (roscpp's getBusStats: the payload alone). Returns nothing while the node ends: its port
/// still accepts calls, but no thread responds to them any more.
std::optional<XmlRpc::XmlRpcValue> call_own_api(const std::string& method, const XmlRpc::XmlRpcValue& arguments);

}  // namespace spring_workbench::ros_common
