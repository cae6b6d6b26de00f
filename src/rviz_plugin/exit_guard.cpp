#include "exit_guard.h"

#include <ros/init.h>

#include <QCoreApplication>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "constants.h"

namespace spring_workbench::rviz_plugin {
namespace {

std::atomic<bool> quits{false};

/// Waits until the program has exited by itself, or exits it after a timeout.
[[noreturn]] void watch() {
  while (!quits && !ros::isShuttingDown()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  std::this_thread::sleep_for(std::chrono::duration<double>(exit_timeout));
  std::fputs("the ROS master does not answer: ending without it\n", stderr);
  std::_Exit(EXIT_SUCCESS);
}

}  // namespace

void guard_exit() {
  static bool guarded = false;
  if (guarded || QCoreApplication::instance() == nullptr) return;
  guarded = true;
  QObject::connect(QCoreApplication::instance(), &QCoreApplication::aboutToQuit, [] { quits = true; });
  std::thread(watch).detach();
}

}  // namespace spring_workbench::rviz_plugin
