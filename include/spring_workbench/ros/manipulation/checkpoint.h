#pragma once

#include <ros/ros.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/live/checkpoint.h"

namespace spring_workbench::manipulation {

/// Stores the checkpoint of a node `manipulation` on the parameter server under `~resume` and, optionally, in a file.
/// It is updated twice a second while something changes, and deleted when the node exits normally.
class Checkpoint {
 public:
  /// Restores the runner from the checkpoint on the master or, if there is none, from the file. A checkpoint of another
  /// scene, or one that cannot be restored, is reported and ignored as a whole (a file is renamed). `master`, `disk`:
  /// private node handles of the threads that may block on these; `file`: path or empty. Others: see live::Checkpoint.
  Checkpoint(const ros::NodeHandle& master, const ros::NodeHandle& disk, const std::string& file,
             live::SimulationRunner& runner, const std::string& given_scene,
             const std::vector<std::string>& scene_roots);
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  /// Writes the checkpoint to a restarted master. Call it in the thread of `master`.
  void keep_on_new_master();
  /// Returns the reason why the file is not up to date; empty if it is, or if there is none.
  std::string file_error() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return file_error_;
  }

 private:
  void resume(const std::vector<std::string>& scene_roots);
  void keep_on_master();
  void keep_in_file();
  void set_file_error(const std::string& file_error);

  ros::NodeHandle master_;
  live::Checkpoint on_master_, in_file_;
  std::optional<live::CheckpointFile> file_;
  mutable std::mutex mutex_;
  std::string file_error_;
  ros::SteadyTimer master_timer_, file_timer_;
};

}  // namespace spring_workbench::manipulation
