#include "spring_workbench/ros/common/subscriptions.h"

#include <chrono>
#include <list>
#include <utility>

namespace spring_workbench::ros_common {

void leave_until_exit(std::future<void> work) {
  static std::list<std::future<void>> unfinished;  // waited for by its destructor
  unfinished.remove_if(
      [](const auto& one) { return one.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  unfinished.push_back(std::move(work));
}

void Subscriptions::end() {
  callbacks_ = boost::make_shared<int>();
  if (subscribers_.empty()) return;
  leave_until_exit(std::async(std::launch::async, [ended = std::exchange(subscribers_, {})]() mutable {
    for (ros::Subscriber& subscriber : ended) subscriber.shutdown();
  }));
}

}  // namespace spring_workbench::ros_common
