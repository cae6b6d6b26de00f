#include "own_api.h"

#include <ros/xmlrpc_manager.h>

#include "constants.h"

namespace spring_workbench::ros_common {

std::optional<XmlRpc::XmlRpcValue> call_own_api(const std::string& method, const XmlRpc::XmlRpcValue& arguments) {
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcClient client("localhost", static_cast<int>(ros::XMLRPCManager::instance()->getServerPort()), "/");
  if (!client.executeNonBlock(method.c_str(), arguments)) return std::nullopt;
  XmlRpc::XmlRpcDispatch line;
  line.addSource(&client, XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  line.work(own_api_timeout);  // until the response is there, at most
  line.removeSource(&client);
  const bool done = client.executeCheckDone(response) && !client.isFault();
  if (!done || response.getType() != XmlRpc::XmlRpcValue::TypeArray) return std::nullopt;
  return response;
}

}  // namespace spring_workbench::ros_common
