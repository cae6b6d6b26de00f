#include "master_watch.h"

#include <ros/console.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

#include <chrono>
#include <string>

#include "constants.h"
#include "exit_guard.h"

namespace spring_workbench::rviz_plugin {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue arguments(const std::string& caller, const std::string& first, const std::string& second = "",
                      const std::string& third = "") {
  XmlRpcValue values;
  int count = 0;
  for (const std::string& value : {caller, first, second, third}) {
    if (!value.empty()) values[count++] = value;
  }
  return values;
}

/// The master's process, 0 while there is none.
int master_process() {
  XmlRpcValue response, payload;
  if (!ros::master::execute("getPid", arguments(ros::this_node::getName(), ""), response, payload, false)) return 0;
  return static_cast<int>(payload);
}

std::shared_ptr<const std::vector<std::string>> published_topics() {
  ros::master::V_TopicInfo all;
  ros::master::getTopics(all);
  std::vector<std::string> names;
  for (const ros::master::TopicInfo& topic : all) names.push_back(topic.name);
  return std::make_shared<const std::vector<std::string>>(std::move(names));
}

/// Tells this node, in the master's place, who publishes a topic.
void announce_publishers(const std::string& topic, const XmlRpcValue& publishers) {
  const std::string uri = ros::XMLRPCManager::instance()->getServerURI();
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return;
  XmlRpc::XmlRpcClient* client = ros::XMLRPCManager::instance()->getXMLRPCClient(host, static_cast<int>(port), uri);
  XmlRpcValue values = arguments("/master", topic), response;
  values[2] = publishers;
  client->execute("publisherUpdate", values, response);
  ros::XMLRPCManager::instance()->releaseXMLRPCClient(client);
}

void register_topics() {
  const std::string& node = ros::this_node::getName();
  const std::string uri = ros::XMLRPCManager::instance()->getServerURI();
  ros::V_string topics;
  XmlRpcValue response, publishers;
  ros::this_node::getAdvertisedTopics(topics);
  for (const std::string& topic : topics) {
    ros::master::execute("registerPublisher", arguments(node, topic, "*", uri), response, publishers, false);
  }
  topics.clear();
  ros::this_node::getSubscribedTopics(topics);
  for (const std::string& topic : topics) {
    if (ros::master::execute("registerSubscriber", arguments(node, topic, "*", uri), response, publishers, false)) {
      announce_publishers(topic, publishers);
    }
  }
  ROS_INFO("new ROS master: registered again");
}

}  // namespace

std::shared_ptr<MasterWatch> MasterWatch::shared() {
  guard_exit();
  static std::weak_ptr<MasterWatch> watch;
  std::shared_ptr<MasterWatch> held = watch.lock();
  if (!held) watch = held = std::shared_ptr<MasterWatch>(new MasterWatch);
  return held;
}

MasterWatch::MasterWatch() : thread_([this] { run(); }) {}

MasterWatch::~MasterWatch() {
  ends_ = true;
  thread_.join();
}

void MasterWatch::run() {
  int known = master_process();
  bool was_gone = false;
  for (int i = 0; !ends_; i = (i + 1) % master_slices) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1000 / master_slices));
    if (i != 0) continue;
    const int process = master_process();
    if (process != 0 && (was_gone || process != known)) register_topics();
    if (process != 0) std::atomic_store(&topics_, published_topics());
    was_gone = process == 0;
    if (process != 0) known = process;
  }
}

}  // namespace spring_workbench::rviz_plugin
