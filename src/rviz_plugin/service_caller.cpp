#include "service_caller.h"

namespace spring_workbench::rviz_plugin {

ServiceCaller::ServiceCaller(std::function<void(const std::string&)> report)
    : report_(std::move(report)), thread_([this] { run(); }) {}

ServiceCaller::~ServiceCaller() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
    client_.shutdown();  // aborts a call that waits for its response
  }
  changed_.notify_all();
  thread_.join();
}

void ServiceCaller::enqueue(const std::string& key, Job job) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.remove_if([&](const auto& entry) { return entry.first == key; });
    waiting_.emplace_back(key, std::move(job));
  }
  changed_.notify_all();
}

ros::ServiceClient ServiceCaller::open(const std::function<ros::ServiceClient()>& make) {
  const ros::ServiceClient client = make();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!ends_) client_ = client;
  return ends_ ? ros::ServiceClient() : client;
}

void ServiceCaller::close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  client_ = ros::ServiceClient();
}

void ServiceCaller::run() {
  for (;;) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    const Job job = std::move(waiting_.front().second);
    waiting_.pop_front();
    lock.unlock();
    report_(job());
  }
}

}  // namespace spring_workbench::rviz_plugin
