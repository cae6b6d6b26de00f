#include "spring_workbench/ros/common/callback_thread.h"

#include <pthread.h>

namespace spring_workbench::ros_common {
namespace {

/// Callback that names the thread in which it runs.
class Naming : public ros::CallbackInterface {
 public:
  explicit Naming(const std::string& name) : name_(name) {}
  CallResult call() override {
    pthread_setname_np(pthread_self(), name_.c_str());
    return Success;
  }

 private:
  std::string name_;
};

}  // namespace

CallbackThread::CallbackThread(const std::string& name) : spinner_(1, &queue_) {
  queue_.addCallback(ros::CallbackInterfacePtr(new Naming(name)));
  spinner_.start();
}

}  // namespace spring_workbench::ros_common
