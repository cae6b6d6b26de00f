#pragma once

#include <ros/node_handle.h>
#include <ros/service.h>
#include <ros/service_client.h>

#include <condition_variable>
#include <functional>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace spring_workbench::ros_common {

/// Calls services from a separate thread, so that a window does not block on a node that has exited or hangs. Of the
/// pending calls with the same key, only the newest is made. Its destructor waits neither for a node nor for the ROS
/// master: the thread ends later by itself, and reports nothing more (leave_until_exit).
class ServiceCaller {
 public:
  /// `report` is called in that thread with one line about each call.
  explicit ServiceCaller(std::function<void(const std::string&)> report);
  ~ServiceCaller();
  ServiceCaller(const ServiceCaller&) = delete;
  ServiceCaller& operator=(const ServiceCaller&) = delete;

  template <class Service>
  void call(const std::string& key, const std::string& service, const typename Service::Request& request) {
    calls_->enqueue(key, [service, request](Calls& calls) {
      Service exchange;
      exchange.request = request;
      if (!ros::service::exists(service, false)) return "no service " + service + ": is its node running?";
      ros::ServiceClient client = calls.open([&] { return calls.node.serviceClient<Service>(service, true); });
      const bool answered = client.call(exchange);
      calls.close();
      return answered ? std::string(exchange.response.message) : "no answer from " + service;
    });
  }

 private:
  struct Calls;
  using Job = std::function<std::string(Calls&)>;

  /// Data of the thread, which may outlive the caller.
  struct Calls {
    void enqueue(const std::string& key, Job job);
    ros::ServiceClient open(const std::function<ros::ServiceClient()>& make);
    void close();
    void run();
    void end();

    ros::NodeHandle node;
    std::function<void(const std::string&)> report;
    std::mutex mutex;
    std::condition_variable changed;
    std::list<std::pair<std::string, Job>> waiting;
    ros::ServiceClient client;  ///< client of the call in progress
    bool ends = false;
  };

  std::shared_ptr<Calls> calls_ = std::make_shared<Calls>();
  std::future<void> thread_;
};

}  // namespace spring_workbench::ros_common
