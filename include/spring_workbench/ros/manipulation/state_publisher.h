#pragma once

#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>

#include "spring_workbench/ros/manipulation/manipulation_parameters.h"
#include "spring_workbench/ros/manipulation/simulation_runner.h"
#include "spring_workbench/ros/markers/markers.h"

namespace spring_workbench::manipulation {

/// Sends what the simulation shows: /tf, ~objects, ~fork, ~fork_2, ~wrench, ~contacts, ~markers, ~steps and ~task.
/// Messages are made only while somebody listens; /tf is sent when the simulated time has gone on.
class StatePublisher {
 public:
  StatePublisher(ros::NodeHandle private_node, const ManipulationParameters& parameters);

  /// Call once per cycle of the physics loop. `stamp`: the simulated time; `now` [s]: local time.
  void publish(const simulation::Simulation& simulation, const ros::Time& stamp, double now);
  void publish_steps(const CycleReport& report, const std::string& integrator, const ros::Time& stamp,
                     bool deadline_missed);
  void publish_task(const SimulationRunner& runner, const ros::Time& stamp);

 private:
  void publish_transforms(const simulation::Simulation& simulation, const ros::Time& stamp);
  void publish_wrench(const tools::ToolState& tool, std_msgs::Header header);
  void publish_contacts(const simulation::Simulation& simulation, const std_msgs::Header& header);
  void publish_markers(const simulation::Simulation& simulation, const std_msgs::Header& header, double now);
  std_msgs::Header header_at(const ros::Time& stamp) const;

  std::string world_frame_;
  double marker_period_;  ///< [s]
  double next_markers_ = 0.0;
  ros::Time last_transforms_;
  bool had_contacts_ = false;
  bool markers_were_built_ = false;  ///< in this cycle
  markers::MarkerBuilder markers_;
  tf2_ros::TransformBroadcaster transforms_;
  ros::Publisher objects_publisher_, fork_publisher_, second_fork_publisher_, wrench_publisher_, contacts_publisher_,
      markers_publisher_, steps_publisher_, task_publisher_;
};

}  // namespace spring_workbench::manipulation
