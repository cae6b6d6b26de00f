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

void run_in_order(std::function<void()> work) {
  static std::future<void> last;  // waited for by its destructor
  last = std::async(std::launch::async, [before = std::move(last), work = std::move(work)] {
    if (before.valid()) before.wait();
    work();
  });
}

void Subscriptions::end() {
  callbacks_ = boost::make_shared<int>();
  run_in_order(
      [ended = std::exchange(subscribers_, std::make_shared<std::vector<ros::Subscriber>>())] { ended->clear(); });
}

}  // namespace spring_workbench::ros_common
