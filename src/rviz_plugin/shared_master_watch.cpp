#include "shared_master_watch.h"

#include <QCoreApplication>
#include <memory>

#include "exit_guard.h"
#include "spring_workbench/ros/common/callback_thread.h"

namespace spring_workbench::rviz_plugin {
namespace {

struct WatchInThread {
  WatchInThread() = default;
  ~WatchInThread() { thread.stop(); }
  WatchInThread(const WatchInThread&) = delete;
  WatchInThread& operator=(const WatchInThread&) = delete;

  ros_common::CallbackThread thread{"master"};
  ros_common::MasterWatch watch{thread.handle(ros::NodeHandle())};
};

}  // namespace

const ros_common::MasterWatch& shared_master_watch() {
  static std::unique_ptr<WatchInThread> shared;
  if (!shared) {
    guard_exit();
    shared = std::make_unique<WatchInThread>();
    if (const QCoreApplication* application = QCoreApplication::instance(); application != nullptr)
      QObject::connect(application, &QCoreApplication::aboutToQuit, [] { shared.reset(); });
  }
  return shared->watch;
}

}  // namespace spring_workbench::rviz_plugin
