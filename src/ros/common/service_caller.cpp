#include "spring_workbench/ros/common/service_caller.h"

#include "spring_workbench/ros/common/subscriptions.h"

namespace spring_workbench::ros_common {

ServiceCaller::ServiceCaller(std::function<void(const std::string&)> report) {
  calls_->report = std::move(report);
  thread_ = std::async(std::launch::async, [calls = calls_] { calls->run(); });
}

ServiceCaller::~ServiceCaller() {
  calls_->end();
  leave_until_exit(std::move(thread_));
}

void ServiceCaller::Calls::end() {
  const std::lock_guard<std::mutex> lock(mutex);
  ends = true;
  client.shutdown();  // aborts a call that waits for its response
  changed.notify_all();
}

void ServiceCaller::Calls::enqueue(const std::string& key, Job job) {
  const std::lock_guard<std::mutex> lock(mutex);
  waiting.remove_if([&](const auto& entry) { return entry.first == key; });
  waiting.emplace_back(key, std::move(job));
  changed.notify_all();
}

ros::ServiceClient ServiceCaller::Calls::open(const std::function<ros::ServiceClient()>& make) {
  const ros::ServiceClient opened = make();
  const std::lock_guard<std::mutex> lock(mutex);
  if (!ends) client = opened;
  return client;
}

void ServiceCaller::Calls::close() {
  const std::lock_guard<std::mutex> lock(mutex);
  client = ros::ServiceClient();
}

void ServiceCaller::Calls::run() {
  for (;;) {
    std::unique_lock<std::mutex> lock(mutex);
    changed.wait(lock, [this] { return ends || !waiting.empty(); });
    if (ends) return;
    const Job job = std::move(waiting.front().second);
    waiting.pop_front();
    lock.unlock();
    const std::string answer = job(*this);
    lock.lock();
    if (!ends) report(answer);
  }
}

}  // namespace spring_workbench::ros_common
