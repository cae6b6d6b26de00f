#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/ros/machine_link/tool_output.h"
#include "spring_workbench/ros/manipulation/frame_publisher.h"
#include "spring_workbench/ros/manipulation/manipulation_parameters.h"
#include "spring_workbench/ros/manipulation/objects_message.h"
#include "spring_workbench/ros/markers/marker_publisher.h"

namespace spring_workbench::manipulation {

/// A committed state to be sent, and what the cycle did that led to it.
struct CommittedState {
  live::Committed committed;
  ros::Time stamp;
  live::CycleReport report;
  double deadline = 0.0;  ///< of the cycle, in local time [s]
};

/// A displayed state to be sent.
struct ShownState {
  live::Shown shown;
  ros::Time stamp;
  double local_time = 0.0;  ///< [s]
};

/// Sends the committed simulation, to be recorded (~objects, ~contacts, ~steps, ~task, and of each stylus ~fork,
/// ~wrench, ~tip_twist, ~joy_feedback and ~probe), the journal (~accepted, ~changes), and what is shown, to be looked
/// at (/tf, ~display/objects, ~display/fork of each stylus, ~markers, ~display/markers). Messages are made only while
/// there is a subscriber.
class StatePublisher {
 public:
  StatePublisher(ros::NodeHandle private_node, const ManipulationParameters& parameters);

  /// `publish_time` [s]: how long the messages before these took.
  void publish(const CommittedState& state, double publish_time);
  void publish(ShownState state);
  /// The journal, while both of its topics have a subscriber.
  void publish_journal(live::SimulationRunner& runner);

 private:
  /// What is sent of one stylus; the topics and frames of the second end in _2, and so on.
  struct HandTopics {
    ros::Publisher fork, shown_fork;
    machine_link::ToolOutput output;
  };
  /// What is sent of all objects; of what was sent before, what has not changed since is still there.
  struct ObjectsTopic {
    ros::Publisher publisher;
    ObjectsMessage message;
    void publish(const live::View& view, const std_msgs::Header& header);
  };
  void publish_hand(std::size_t hand, const live::View& view, const std_msgs::Header& header);
  void publish_contacts(const live::View& view, const std_msgs::Header& header);
  std_msgs::Header header_at(const ros::Time& stamp) const;

  std::string world_frame_;
  double horizon_ = 0.0;
  bool had_contacts_ = false;
  bool markers_were_built_ = false;  ///< with the last shown state
  double fork_diameter_;
  markers::MarkerPublisher markers_;
  FramePublisher frames_;
  ObjectsTopic objects_, shown_objects_;
  ros::Publisher contacts_publisher_, steps_publisher_, task_publisher_, accepted_publisher_, changes_publisher_;
  std::vector<HandTopics> hands_;
  std::uint32_t journal_listeners_ = 0;
};

}  // namespace spring_workbench::manipulation
