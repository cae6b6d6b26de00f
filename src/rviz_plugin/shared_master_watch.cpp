#include "shared_master_watch.h"

#include <QCoreApplication>
#include <atomic>
#include <memory>

#include "constants.h"
#include "spring_workbench/ros/common/callback_thread.h"
#include "spring_workbench/ros/common/exit_after_timeout.h"

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

std::atomic<bool> quits{false};

}  // namespace

const ros_common::MasterWatch& shared_master_watch() {
  static std::unique_ptr<WatchInThread> shared;
  if (!shared) {
    shared = std::make_unique<WatchInThread>();
    ros_common::exit_after_timeout([] { return quits || ros::isShuttingDown(); }, EXIT_SUCCESS, exit_timeout);
    QObject::connect(QCoreApplication::instance(), &QCoreApplication::aboutToQuit, [] {
      quits = true;
      shared.reset();
    });
  }
  return shared->watch;
}

}  // namespace spring_workbench::rviz_plugin
