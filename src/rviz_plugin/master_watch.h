#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace spring_workbench::rviz_plugin {

/// Makes this process known to a ROS master that was restarted: roscpp registers topics once, with the master that is
/// there then. Looks once a second, in a thread of its own.
class MasterWatch {
 public:
  /// The one of this process; lives as long as somebody holds it.
  static std::shared_ptr<MasterWatch> shared();
  ~MasterWatch();
  /// The topics with a publisher, as the master said last; null before that.
  std::shared_ptr<const std::vector<std::string>> topics() const { return std::atomic_load(&topics_); }

 private:
  MasterWatch();
  void run();

  std::shared_ptr<const std::vector<std::string>> topics_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace spring_workbench::rviz_plugin
