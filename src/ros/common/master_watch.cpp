#include "spring_workbench/ros/common/master_watch.h"

#include <ros/connection_manager.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "constants.h"
#include "own_api.h"
#include "spring_workbench/ros/common/loop_clock.h"

namespace spring_workbench::ros_common {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue strings(std::initializer_list<std::string> values) {
  XmlRpcValue array;
  for (const std::string& value : values) array[array.valid() ? array.size() : 0] = value;
  return array;
}

/// Calls the master; `arguments` go after this node's name. Does not wait for a master that is not there.
bool call_master(const std::string& method, std::initializer_list<std::string> arguments, XmlRpcValue& payload) {
  XmlRpcValue request = strings({ros::this_node::getName()}), response;
  for (const std::string& argument : arguments) request[request.size()] = argument;
  return ros::master::execute(method, request, response, payload, false);
}

/// Names of nodes by topic or service: a list of [name, [node, ...]].
std::map<std::string, std::vector<std::string>> by_name(XmlRpcValue& list) {
  std::map<std::string, std::vector<std::string>> nodes;
  for (int i = 0; i < list.size(); ++i) {
    std::vector<std::string>& of_name = nodes[list[i][0]];
    for (int k = 0; k < list[i][1].size(); ++k) of_name.push_back(list[i][1][k]);
  }
  return nodes;
}

/// URIs of the publishers that this process is connected with. getBusInfo has [number, URI, direction, transport,
/// topic] of each connection.
std::vector<std::string> connected_publishers(const std::string& topic) {
  std::vector<std::string> uris;
  std::optional<XmlRpcValue> response = call_own_api("getBusInfo", strings({ros::this_node::getName()}));
  if (!response || response->size() < 3) return uris;
  XmlRpcValue& connections = (*response)[2];
  for (int i = 0; i < connections.size(); ++i) {
    XmlRpcValue& connection = connections[i];
    if (std::string(connection[2]) == "i" && std::string(connection[4]) == topic) uris.push_back(connection[1]);
  }
  return uris;
}

/// Does what a master does when a topic's publishers change.
void send_publisher_update(const std::string& topic, XmlRpcValue publishers) {
  for (const std::string& uri : connected_publishers(topic)) publishers[publishers.size()] = uri;
  XmlRpcValue request = strings({"/master", topic});
  request[2] = publishers;
  call_own_api("publisherUpdate", request);
}

}  // namespace

MasterWatch::MasterWatch(const ros::NodeHandle& node, std::function<void()> on_new_master)
    : on_new_master_(std::move(on_new_master)),
      own_uri_(ros::XMLRPCManager::instance()->getServerURI()),
      services_uri_("rosrpc://" + ros::network::getHost() + ":" +
                    std::to_string(ros::ConnectionManager::instance()->getTCPPort())) {
  Answer none;
  none.received = steady_time();
  answer_ = std::make_shared<const Answer>(std::move(none));
  ros::param::get(ros::this_node::getName(), parameters_);
  timer_ = node.createSteadyTimer(ros::WallDuration(master_period), [this](const ros::SteadyTimerEvent&) { look(); });
}

std::shared_ptr<const MasterWatch::Answer> MasterWatch::answer() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return answer_;
}

/// roscpp gives each node services of its own (~get_loggers), so a master that lists none does not know this process.
void MasterWatch::look() {
  XmlRpcValue state;
  if (!call_master("getSystemState", {}, state)) return;
  Answer answer;
  answer.received = steady_time();
  answer.publishers = by_name(state[0]);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    answer_ = std::make_shared<const Answer>(std::move(answer));
  }
  std::vector<std::string> services;
  for (const auto& [service, nodes] : by_name(state[2])) {
    if (std::find(nodes.begin(), nodes.end(), ros::this_node::getName()) != nodes.end()) services.push_back(service);
  }
  if (services.empty() && !services_.empty()) {
    if (!ros::isShuttingDown()) register_with_new_master();  // otherwise this node has unregistered them
  } else {
    services_ = services;
    learn_types();
    if (subscribers_due_ > 1 || (subscribers_due_ == 1 && register_subscribers())) --subscribers_due_;
  }
}

/// From the master, since roscpp does not tell.
void MasterWatch::learn_types() {
  ros::V_string topics;
  ros::this_node::getAdvertisedTopics(topics);
  const auto is_known = [this](const std::string& topic) { return types_.count(topic) > 0; };
  XmlRpcValue all;
  if (std::all_of(topics.begin(), topics.end(), is_known) || !call_master("getTopicTypes", {}, all)) return;
  for (int i = 0; i < all.size(); ++i) types_[all[i][0]] = std::string(all[i][1]);
}

/// The services come last: if the master goes away in between, the next look begins again.
void MasterWatch::register_with_new_master() {
  XmlRpcValue payload;
  ros::V_string topics;
  ros::this_node::getAdvertisedTopics(topics);
  if (parameters_.valid()) ros::param::set(ros::this_node::getName(), parameters_);
  on_new_master_();
  for (const std::string& topic : topics) {
    const auto type = types_.find(topic);
    call_master("registerPublisher", {topic, type == types_.end() ? "*" : type->second, own_uri_}, payload);
  }
  for (const std::string& service : services_)
    call_master("registerService", {service, services_uri_, own_uri_}, payload);
  subscribers_due_ = subscribers_later;
  ROS_WARN("new ROS master: registered again");
}

bool MasterWatch::register_subscribers() const {
  ros::V_string topics;
  ros::this_node::getSubscribedTopics(topics);
  for (const std::string& topic : topics) {
    XmlRpcValue publishers;
    if (!call_master("registerSubscriber", {topic, "*", own_uri_}, publishers)) return false;
    send_publisher_update(topic, publishers);
  }
  return true;
}

}  // namespace spring_workbench::ros_common
