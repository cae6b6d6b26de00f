#pragma once

#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <atomic>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/ros/common/callback_thread.h"
#include "spring_workbench/ros/common/loop_clock.h"
#include "spring_workbench/ros/common/lost_messages.h"
#include "spring_workbench/ros/common/master_watch.h"
#include "spring_workbench/ros/machine_link/wrench_input.h"
#include "spring_workbench/ros/manipulation/checkpoint.h"
#include "spring_workbench/ros/manipulation/diagnostics.h"
#include "spring_workbench/ros/manipulation/manipulation_parameters.h"
#include "spring_workbench/ros/manipulation/outbox.h"
#include "spring_workbench/ros/manipulation/state_publisher.h"
#include "spring_workbench/ros/manipulation/stylus_input.h"
#include "spring_workbench/ros/markers/scene_publisher.h"
#include "spring_workbench/ros/services/live_tuning.h"
#include "spring_workbench/ros/services/services.h"

namespace spring_workbench::manipulation {

/// The node `manipulation`. Subscribes to tf and buttons, runs the physics in its own thread (woken by samples; on the
/// steady clock or, under `use_sim_time`, on ROS time), and publishes states, markers and reports from another thread.
/// The caller has to spin the global callback queue. For an orderly exit, destroy it before ros::shutdown().
class ManipulationNode {
 public:
  /// Reads parameters and scene. Throws InputError if one is invalid.
  ManipulationNode(ros::NodeHandle node, const ros::NodeHandle& private_node);
  ~ManipulationNode();
  ManipulationNode(const ManipulationNode&) = delete;
  ManipulationNode& operator=(const ManipulationNode&) = delete;

 private:
  void run_physics();
  bool run_step(double begin);
  std::deque<StylusInput> listen(const ros::NodeHandle& node);
  void count(const live::CycleReport& report, bool deadline_missed);
  void publish_diagnostics(const ros::SteadyTimerEvent&);
  void place_workbench();
  void describe_scene();

  const ManipulationParameters parameters_;
  live::SimulationRunner runner_;
  ros_common::Alarm alarm_;
  ros_common::CallbackThread input_thread_{"input"}, master_thread_{"master"}, disk_thread_{"disk"};
  ros_common::CallbackThread tuning_thread_{"tuning"};  ///< it tells each change to the master, and waits for it
  std::deque<StylusInput> inputs_;
  machine_link::WrenchInput wrenches_;
  StatePublisher publisher_;
  Outbox outbox_;
  markers::ScenePublisher scene_publisher_;
  std::vector<ros::ServiceServer> services_;
  std::unique_ptr<services::LiveTuning> live_tuning_;
  Checkpoint checkpoint_;
  ManipulationDiagnostics diagnostics_;
  ros_common::LostMessages lost_messages_;
  std::mutex loop_mutex_;
  LoopStatistics loop_;
  bool workbench_placed_ = false;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  ros::Publisher diagnostics_publisher_;
  ros::SteadyTimer diagnostics_timer_, scene_timer_;
  ros_common::MasterWatch master_watch_;
  live::ShowTimes show_times_;  ///< schedule of the display while there is more to commit, steady clock
  std::atomic<bool> stop_{false};
  std::atomic<int> realtime_priority_{0};
  std::thread physics_;
};

}  // namespace spring_workbench::manipulation
