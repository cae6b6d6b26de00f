#pragma once

#include <ros/ros.h>

#include <array>
#include <string>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/ros/machine_link/tool_output.h"
#include "spring_workbench/ros/manipulation/frame_publisher.h"
#include "spring_workbench/ros/manipulation/manipulation_parameters.h"
#include "spring_workbench/ros/manipulation/objects_message.h"
#include "spring_workbench/ros/markers/marker_publisher.h"

namespace spring_workbench::manipulation {

/// A committed state to be sent, with the report of the cycle that led to it.
struct CommittedState {
  live::Committed committed;
  ros::Time stamp;
  live::CycleReport report;
  double deadline = 0.0;  ///< deadline of the cycle, in local time [s]
};

/// A displayed state to be sent.
struct ShownState {
  live::Shown shown;
  ros::Time stamp;
  double local_time = 0.0;  ///< [s]
};

/// Publishes the committed simulation for recording (~objects, ~contacts, ~steps, ~task, and for each stylus ~fork,
/// ~wrench, ~tip_twist, ~joy_feedback and ~probe), the journal (~accepted, ~changes), and the displayed state for
/// viewing (/tf, ~display/objects, ~display/fork of each stylus, ~markers, ~display/markers). A message is built only
/// if it has a subscriber.
class StatePublisher {
 public:
  StatePublisher(ros::NodeHandle private_node, const ManipulationParameters& parameters);

  /// `publish_time` [s]: time that publishing the previous messages took.
  void publish(const CommittedState& state, double publish_time);
  void publish(ShownState state);
  /// Publishes the journal while both of its topics have a subscriber.
  void publish_journal(live::SimulationRunner& runner);

 private:
  /// Publishers for one stylus. The topics and frames of the second stylus end in _2, and so on.
  struct HandTopics {
    ros::Publisher fork, shown_fork;
    machine_link::ToolOutput output;
  };
  /// Publisher for all objects; the message keeps the unchanged objects of the previous one.
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
  bool markers_were_built_ = false;  ///< whether markers were built with the last displayed state
  double fork_diameter_;
  markers::MarkerPublisher markers_;
  FramePublisher frames_;
  ObjectsTopic objects_, shown_objects_;
  ros::Publisher contacts_publisher_, steps_publisher_, task_publisher_, accepted_publisher_, changes_publisher_;
  std::vector<HandTopics> hands_;
  std::array<std::uint32_t, 2> journal_listeners_{};  ///< subscribers of `accepted` and of `changes`
};

}  // namespace spring_workbench::manipulation
