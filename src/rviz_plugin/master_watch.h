#pragma once

#include <atomic>
#include <memory>
#include <thread>

namespace spring_workbench::rviz_plugin {

/// Makes this process known to a ROS master that was restarted: roscpp registers topics once, with the master that is
/// there then. Looks once a second, in a thread of its own.
class MasterWatch {
 public:
  /// The one of this process; lives as long as somebody holds it.
  static std::shared_ptr<MasterWatch> shared();
  ~MasterWatch();

 private:
  MasterWatch();
  void run();

  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace spring_workbench::rviz_plugin
