#pragma once

#include <ros/node_handle.h>
#include <ros/service.h>
#include <ros/service_client.h>

#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace spring_workbench::rviz_plugin {

/// Calls services from a separate thread, so that rviz does not block on a node that has exited or hangs. Of the
/// pending calls with the same key, only the newest is made.
class ServiceCaller {
 public:
  /// `report` is called in that thread with one line about each call.
  explicit ServiceCaller(std::function<void(const std::string&)> report);
  ~ServiceCaller();

  template <class Service>
  void call(const std::string& key, const std::string& service, const typename Service::Request& request) {
    enqueue(key, [this, service, request] {
      Service exchange;
      exchange.request = request;
      if (!ros::service::exists(service, false)) return "no service " + service + ": is its node running?";
      ros::ServiceClient client = open([&] { return node_.serviceClient<Service>(service, true); });
      const bool answered = client.call(exchange);
      close();
      return answered ? std::string(exchange.response.message) : "no answer from " + service;
    });
  }

 private:
  using Job = std::function<std::string()>;

  void enqueue(const std::string& key, Job job);
  ros::ServiceClient open(const std::function<ros::ServiceClient()>& make);
  void close();
  void run();

  ros::NodeHandle node_;
  const std::function<void(const std::string&)> report_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::pair<std::string, Job>> waiting_;
  ros::ServiceClient client_;  ///< client of the call in progress
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace spring_workbench::rviz_plugin
