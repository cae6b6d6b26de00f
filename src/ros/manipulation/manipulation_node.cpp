#include "spring_workbench/ros/manipulation/manipulation_node.h"

#include <algorithm>
#include <filesystem>

#include "constants.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/ros/common/loop_clock.h"
#include "spring_workbench/ros/common/parameters.h"
#include "spring_workbench/ros/common/realtime.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::manipulation {
namespace {

/// The nodes that publish /tf, without this one.
std::vector<std::string> senders_of_tf(const ros_common::MasterWatch::Answer& answer) {
  const auto found = answer.publishers.find("/tf");
  if (found == answer.publishers.end()) return {};
  std::vector<std::string> senders = found->second;
  senders.erase(std::remove(senders.begin(), senders.end(), ros::this_node::getName()), senders.end());
  return senders;
}

/// The given folders and the folder of the initial scene.
std::vector<std::string> scene_roots(const ManipulationParameters& parameters, live::SimulationRunner& runner) {
  std::vector<std::string> roots = parameters.scene_roots;
  runner.locked([&](const simulation::Simulation& simulation) {
    roots.push_back(std::filesystem::path(simulation.scene().path).parent_path().string());
  });
  return roots;
}

}  // namespace

ManipulationNode::ManipulationNode(ros::NodeHandle node, const ros::NodeHandle& private_node)
    : parameters_(
          read_manipulation_parameters(ros_common::private_parameters(private_node), private_node.getNamespace())),
      runner_(scene::load_scene(parameters_.scene, {}, private_node.getNamespace() + ": scene"), parameters_.simulation,
              parameters_.input, ros::Time::isSimTime()),
      inputs_(listen(input_thread_.handle(node))),
      wrenches_(input_thread_.handle(private_node), inputs_.size(), parameters_.world_frame, parameters_.frame_prefix,
                parameters_.max_age, [this] { alarm_.ring(); }),
      publisher_(private_node, parameters_),
      outbox_(publisher_, runner_),
      scene_publisher_(private_node, parameters_.world_frame),
      services_(services::advertise_services(private_node, runner_, scene_roots(parameters_, runner_))),
      live_tuning_(services::make_live_tuning(tuning_thread_.handle(private_node), runner_)),
      checkpoint_(master_thread_.handle(private_node), disk_thread_.handle(private_node), parameters_.checkpoint_file,
                  runner_, parameters_.scene, scene_roots(parameters_, runner_)),
      diagnostics_(private_node.getNamespace(), parameters_.simulation.dropout_after),
      diagnostics_publisher_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)),
      diagnostics_timer_(node.createSteadyTimer(ros::WallDuration(1.0), &ManipulationNode::publish_diagnostics, this)),
      scene_timer_(node.createSteadyTimer(ros::WallDuration(scene_period),
                                          [this](const ros::SteadyTimerEvent&) { describe_scene(); })),
      master_watch_(master_thread_.handle(node), [this] { checkpoint_.keep_on_new_master(); }),
      show_times_(1.0 / parameters_.rate),
      physics_([this] { run_physics(); }) {
  runner_.locked([](const simulation::Simulation& simulation) {
    for (const std::string& warning : simulation.scene().warnings) ROS_WARN_STREAM(warning);
    ROS_INFO("scene %s: %zu bodies", simulation.scene().name.c_str(), simulation.scene().bodies.size());
  });
}

std::deque<StylusInput> ManipulationNode::listen(const ros::NodeHandle& node) {
  std::deque<StylusInput> inputs;
  for (int k = 0; k < parameters_.simulation.styluses; ++k)
    inputs.emplace_back(node, parameters_, inputs.size(), [this] { alarm_.ring(); });
  return inputs;
}

ManipulationNode::~ManipulationNode() {
  stop_ = true;
  alarm_.ring();
  physics_.join();
  // Their callbacks use members that are destroyed next.
  for (ros_common::CallbackThread* thread : {&input_thread_, &master_thread_, &disk_thread_, &tuning_thread_})
    thread->stop();
}

void ManipulationNode::run_physics() {
  realtime_priority_ = ros_common::take_realtime_priority(parameters_.realtime_priority);
  const double period = 1.0 / parameters_.rate;
  double due = ros_common::loop_time();
  while (!stop_ && ros::ok()) {
    const double begin = ros_common::loop_time();
    while (!stop_ && run_step(std::min(begin, due))) continue;
    const double now = ros_common::loop_time();
    if (now >= due) due = due + period > now ? due + period : now + period;
    due = std::min(due, now + period);  // the clock may have jumped back
    alarm_.sleep_until(due);
  }
}

/// Runs a step; returns whether more is due immediately. `begin`: time at which it was due or a sample came [s].
bool ManipulationNode::run_step(double begin) {
  const hand_input::LocalTime local = ros_common::local_time();
  live::HandEvents events;
  for (std::size_t hand = 0; hand < inputs_.size(); ++hand) events[hand] = inputs_[hand].take_events();
  wrenches_.add_to(events);
  const live::CycleReport report = runner_.cycle(events, local);
  for (std::size_t hand = 0; hand < inputs_.size(); ++hand) inputs_[hand].count_rejected(report.rejected[hand]);
  // A simulated clock may have advanced in the meantime.
  const double deadline = (ros::Time::isSimTime() ? std::max(begin, local.loop) : begin) + 1.0 / parameters_.rate;
  if (const double now = ros_common::steady_time(); !report.more || show_times_.due(now)) {
    outbox_.take_shown(parameters_.display_latency, local);
    show_times_.shown(now, ros_common::steady_time());
  }
  const bool sent = outbox_.take_committed(report, deadline);
  count(report, !sent && ros_common::loop_time() > deadline);
  return report.more;
}

void ManipulationNode::count(const live::CycleReport& report, bool deadline_missed) {
  if (const double skipped = report.time_skipped; skipped > 0.0)
    ROS_WARN("no input for %.3g s (clock jumped or node stopped): this time is skipped, and nothing moves", skipped);
  const std::lock_guard<std::mutex> lock(loop_mutex_);
  ++loop_.cycles;
  loop_.deadlines_missed += deadline_missed ? 1 : 0;
  loop_.advance.add(report.advance);
  loop_.time_skipped += report.time_skipped;
  loop_.cycles_behind += report.behind ? 1 : 0;
  loop_.longest_cycle = std::max(loop_.longest_cycle, report.wall_time);
}

void ManipulationNode::publish_diagnostics(const ros::SteadyTimerEvent&) {
  place_workbench();
  runner_.note_state();
  std::unique_lock<std::mutex> loop_lock(loop_mutex_);
  LoopStatistics loop = loop_;
  loop_lock.unlock();
  loop.deadlines_missed += outbox_.deadlines_missed();
  loop.waits = outbox_.waits();
  loop.prediction_error = runner_.prediction_error_99();
  loop.checkpoint_error = checkpoint_.file_error();
  loop.realtime_priority = realtime_priority_;
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ros::Time::now();
  std::vector<TrackerInput> all;
  for (const StylusInput& input : inputs_) all.push_back({input.statistics(), runner_.hand_statistics(all.size()), ""});
  std::string& hint = all.front().hint;
  const auto answer = master_watch_.answer();
  hint = hint_for_silence(all.front(), senders_of_tf(*answer), parameters_.stylus_frame);
  loop.master_silence = ros_common::steady_time() - answer->received;
  if (!hint.empty()) ROS_WARN_STREAM_DELAYED_THROTTLE(hint_period, "no sample of the stylus yet: " << hint);
  message.status = diagnostics_.report(all, loop, ros_common::loop_time());
  wrenches_.report(loop.advance.wrench_timeouts, message.status);
  message.status.push_back(lost_messages_.report(ros::this_node::getName()));
  diagnostics_publisher_.publish(message);
}

void ManipulationNode::describe_scene() { scene_publisher_.keep(runner_.scene()); }

void ManipulationNode::place_workbench() {
  if (workbench_placed_ || parameters_.workbench_frame == parameters_.world_frame) return;
  workbench_placed_ = true;
  if (inputs_.front().workbench_known()) return;
  static_transforms_.sendTransform(ros_common::to_transform(RigidTransform::Identity(), parameters_.world_frame,
                                                            parameters_.workbench_frame, ros::Time::now()));
}

}  // namespace spring_workbench::manipulation
