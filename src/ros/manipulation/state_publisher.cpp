#include "spring_workbench/ros/manipulation/state_publisher.h"

#include <algorithm>

#include "constants.h"
#include "messages.h"
#include "spring_workbench/ros/common/loop_clock.h"
#include "spring_workbench/ros/common/publishing.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::manipulation {

using ros_common::publish_made;

StatePublisher::StatePublisher(ros::NodeHandle private_node, const ManipulationParameters& parameters)
    : world_frame_(parameters.world_frame),
      fork_diameter_(parameters.fork_diameter),
      markers_(private_node, parameters.fork_curve, parameters.fork_diameter, parameters.markers_rate),
      frames_(private_node, parameters.world_frame, parameters.frame_prefix),
      objects_{private_node.advertise<ObjectStates>("objects", state_queue), {}},
      shown_objects_{private_node.advertise<ObjectStates>("display/objects", 5), {}},
      contacts_publisher_(private_node.advertise<Contacts>("contacts", state_queue)),
      steps_publisher_(private_node.advertise<StepReport>("steps", state_queue)),
      task_publisher_(private_node.advertise<TaskState>("task", state_queue)),
      accepted_publisher_(private_node.advertise<Accepted>("accepted", state_queue)),
      changes_publisher_(private_node.advertise<Change>("changes", state_queue)) {
  for (int k = 0; k < parameters.simulation.styluses; ++k) {
    const std::string number = ros_common::hand_suffix(hands_.size());
    hands_.push_back({private_node.advertise<ForkState>("fork" + number, state_queue),
                      private_node.advertise<ForkState>("display/fork" + number, 5),
                      machine_link::ToolOutput(private_node, parameters.frame_prefix, number, state_queue)});
  }
}

void StatePublisher::publish_journal(live::SimulationRunner& runner) {
  const std::array<std::uint32_t, 2> listeners = {accepted_publisher_.getNumSubscribers(),
                                                  changes_publisher_.getNumSubscribers()};
  const auto are_heard = [](const auto& topics) { return topics[0] > 0 && topics[1] > 0; };
  const bool has_new = listeners[0] > journal_listeners_[0] || listeners[1] > journal_listeners_[1];
  // A late subscriber starts with the current state, whichever topic it was connected to first.
  if (are_heard(listeners) && has_new) runner.keep_journal(true);
  if (!are_heard(listeners) && are_heard(journal_listeners_)) runner.keep_journal(false);
  journal_listeners_ = listeners;
  for (const live::Entry& entry : runner.take_journal()) {
    const std_msgs::Header header = header_at(ros_common::stamp_of(entry.stamp));
    const auto send = [&](auto message, const ros::Publisher& publisher) {
      message.header = header;
      message.index = entry.index;
      message.committed = entry.committed;
      message.target = entry.target;
      publisher.publish(message);
    };
    const auto* accepted = std::get_if<hand_input::AcceptedInput>(&entry.what);
    if (accepted != nullptr) send(to_message(*accepted), accepted_publisher_);
    if (accepted == nullptr) send(to_message(std::get<live::Change>(entry.what)), changes_publisher_);
  }
}

void StatePublisher::publish(const CommittedState& state, double publish_time) {
  const live::View& view = state.committed.view;
  const std_msgs::Header header = header_at(state.stamp);
  objects_.publish(view, header);
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) publish_hand(hand, view, header);
  publish_contacts(view, header);
  publish_made(task_publisher_, header, [&] { return to_message(state.committed.placements, state.committed.score); });
  publish_made(steps_publisher_, header, [&] {
    const live::CycleReport& report = state.report;
    StepReport message = to_message(state.committed.work.advance);
    (markers_were_built_ ? message.active : message.skipped).push_back("markers");
    message.wall_time = state.committed.work.wall_time;
    message.publish_time = publish_time;
    message.deadline_missed = ros_common::loop_time() > state.deadline;
    message.integrator = validation::name_of(view.settings.dynamics.integrator);
    message.behind = report.behind;
    message.input_age = report.input_age;
    message.horizon = horizon_;
    message.prediction_error = state.committed.work.prediction.position;
    message.prediction_angle_error = state.committed.work.prediction.angle;
    return message;
  });
}

void StatePublisher::publish(ShownState state) {
  horizon_ = state.shown.horizon;
  live::View& view = state.shown.view;
  const std_msgs::Header header = header_at(state.stamp);
  shown_objects_.publish(view, header);
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
    tools::ToolState& tool = view.tools[hand];
    hands_[hand].output.show(tool);
    if (hand == 0 || tool.present)
      publish_made(hands_[hand].shown_fork, header, [&] { return to_message(tool, fork_diameter_); });
  }
  frames_.publish(view, state.stamp);
  markers_were_built_ = markers_.publish(view, header, state.local_time);
}

void StatePublisher::ObjectsTopic::publish(const live::View& view, const std_msgs::Header& header) {
  if (publisher.getNumSubscribers() == 0) return;
  message.write(header, view.objects);
  publisher.publish(message);
}

void StatePublisher::publish_hand(std::size_t hand, const live::View& view, const std_msgs::Header& header) {
  tools::ToolState tool = view.tools[hand];
  hands_[hand].output.read(view, tool);
  if (hand > 0 && !tool.present) return;
  publish_made(hands_[hand].fork, header, [&] { return to_message(tool, fork_diameter_); });
  hands_[hand].output.publish(view, tool, header);
}

void StatePublisher::publish_contacts(const live::View& view, const std_msgs::Header& header) {
  const bool has_contacts = !view.contacts.empty();
  if (has_contacts || had_contacts_)
    publish_made(contacts_publisher_, header, [&] { return to_message(view.contacts); });
  had_contacts_ = has_contacts;
}

std_msgs::Header StatePublisher::header_at(const ros::Time& stamp) const {
  std_msgs::Header header;
  header.frame_id = world_frame_;
  header.stamp = stamp;
  return header;
}

}  // namespace spring_workbench::manipulation
