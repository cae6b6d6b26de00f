#include "spring_workbench/ros/manipulation/state_publisher.h"

#include <geometry_msgs/WrenchStamped.h>

#include <algorithm>

#include "constants.h"
#include "messages.h"
#include "spring_workbench/ros/common/conversions.h"

namespace spring_workbench::manipulation {
namespace {

const std::string handle_frame = "fork_handle";
const std::string tip_frame = "fork_tip";

/// What `make` makes, only where somebody listens.
template <typename Make>
void publish_made(const ros::Publisher& publisher, const std_msgs::Header& header, Make&& make) {
  if (publisher.getNumSubscribers() == 0) return;
  auto message = make();
  message.header = header;
  publisher.publish(message);
}

}  // namespace

StatePublisher::StatePublisher(ros::NodeHandle private_node, const ManipulationParameters& parameters)
    : world_frame_(parameters.world_frame),
      marker_period_(1.0 / parameters.markers_rate),
      markers_(parameters.fork_curve, std::max(shortest_marker_lifetime, 3.0 / parameters.markers_rate)),
      objects_publisher_(private_node.advertise<ObjectStates>("objects", state_queue)),
      fork_publisher_(private_node.advertise<ForkState>("fork", state_queue)),
      second_fork_publisher_(private_node.advertise<ForkState>("fork_2", state_queue)),
      wrench_publisher_(private_node.advertise<geometry_msgs::WrenchStamped>("wrench", state_queue)),
      contacts_publisher_(private_node.advertise<Contacts>("contacts", state_queue)),
      markers_publisher_(private_node.advertise<visualization_msgs::MarkerArray>("markers", 10)),
      steps_publisher_(private_node.advertise<StepReport>("steps", state_queue)),
      task_publisher_(private_node.advertise<TaskState>("task", state_queue)) {}

void StatePublisher::publish(const simulation::Simulation& simulation, const ros::Time& stamp, double now) {
  const std_msgs::Header header = header_at(stamp);
  const tools::ToolState tool = simulation.fork();
  publish_transforms(simulation, stamp);
  publish_made(objects_publisher_, header, [&] { return to_message(simulation.objects()); });
  publish_made(fork_publisher_, header, [&] { return to_message(tool); });
  if (const tools::ToolState second = simulation.fork(1); second.present)
    publish_made(second_fork_publisher_, header, [&] { return to_message(second); });
  publish_wrench(tool, header);
  publish_contacts(simulation, header);
  publish_markers(simulation, header, now);
}

void StatePublisher::publish_transforms(const simulation::Simulation& simulation, const ros::Time& stamp) {
  if (stamp.isZero() || stamp == last_transforms_) return;
  last_transforms_ = stamp;
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (std::size_t hand = 0; hand < simulation::Simulation::most_hands; ++hand) {
    const tools::ToolState tool = simulation.fork(hand);
    if (hand > 0 && !tool.present) continue;
    const std::string number = hand > 0 ? "_" + std::to_string(hand + 1) : "";
    transforms.push_back(ros_common::to_transform(tool.X_WH, world_frame_, handle_frame + number, stamp));
    transforms.push_back(ros_common::to_transform(tool.X_WE, world_frame_, tip_frame + number, stamp));
  }
  for (const bodies::BodyState& object : simulation.objects()) {
    const scene::Body& body = simulation.scene().bodies[*scene::find_body(simulation.scene(), object.name)];
    transforms.push_back(ros_common::to_transform(object.X_WO * body.X_OL, world_frame_, object.name, stamp));
  }
  transforms_.sendTransform(transforms);
}

/// In real units: what the hand would feel.
void StatePublisher::publish_wrench(const tools::ToolState& tool, std_msgs::Header header) {
  header.frame_id = handle_frame;
  publish_made(wrench_publisher_, header, [&] {
    geometry_msgs::WrenchStamped message;
    const Wrench& felt = tool.handle_wrench_H;
    message.wrench = ros_common::to_wrench({felt.force / tool.force_scale, felt.moment / tool.force_scale});
    return message;
  });
}

void StatePublisher::publish_contacts(const simulation::Simulation& simulation, const std_msgs::Header& header) {
  const bool has_contacts = !simulation.contacts().empty();
  if (has_contacts || had_contacts_) {
    Contacts message = to_message(simulation.contacts());
    message.header = header;
    contacts_publisher_.publish(message);
  }
  had_contacts_ = has_contacts;
}

void StatePublisher::publish_markers(const simulation::Simulation& simulation, const std_msgs::Header& header,
                                     double now) {
  markers_were_built_ = false;
  const bool wait = now < next_markers_ && now > next_markers_ - marker_period_;  // a clock that went back waits not
  if (wait || markers_publisher_.getNumSubscribers() == 0) return;
  next_markers_ = now < next_markers_ + marker_period_ && now >= next_markers_ ? next_markers_ + marker_period_
                                                                               : now + marker_period_;
  markers_were_built_ = true;
  markers_publisher_.publish(markers_.build(simulation, header));
}

void StatePublisher::publish_steps(const CycleReport& report, const std::string& integrator, const ros::Time& stamp,
                                   bool deadline_missed) {
  publish_made(steps_publisher_, header_at(stamp), [&] {
    StepReport message = to_message(report.advance);
    (markers_were_built_ ? message.active : message.skipped).push_back("markers");
    message.wall_time = report.wall_time;
    message.integrator = integrator;
    message.deadline_missed = deadline_missed;
    return message;
  });
}

void StatePublisher::publish_task(const SimulationRunner& runner, const ros::Time& stamp) {
  publish_made(task_publisher_, header_at(stamp), [&] {
    const assembly::TaskMonitor task = runner.task();
    return to_message(task.placements(), task.score());
  });
}

std_msgs::Header StatePublisher::header_at(const ros::Time& stamp) const {
  std_msgs::Header header;
  header.frame_id = world_frame_;
  header.stamp = stamp;
  return header;
}

}  // namespace spring_workbench::manipulation
