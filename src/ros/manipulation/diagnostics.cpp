#include "spring_workbench/ros/manipulation/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::manipulation {

using diagnostic_msgs::DiagnosticStatus;
using ros_common::increase;

std::string hint_for_silence(const TrackerInput& tracker, const std::vector<std::string>& senders,
                             const std::string& stylus_frame) {
  const InputStatistics& input = tracker.input;
  if (tracker.hand.stream.samples > 0) return "";
  if (input.messages == 0 && senders.empty()) return "no publisher on /tf: is tracker_driver, or a bag, running?";
  if (input.messages == 0) {
    return validation::join(senders) +
           " should send /tf, but nothing arrives: is ROS_IP or ROS_HOSTNAME set on the sender's host, and "
           "is the device on?";
  }
  if (input.frames.count(stylus_frame) == 0) {
    return "no frame " + stylus_frame + " on /tf, but " + validation::join({input.frames.begin(), input.frames.end()}) +
           ": is the parameter stylus_frame correct?";
  }
  const auto most = std::max_element(input.rejected.begin(), input.rejected.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == input.rejected.end()) return "";
  if (most->first == "too old" || most->first == "from the future") {
    std::ostringstream text;
    text << "all samples are " << most->first << ", the newest by " << std::abs(input.newest_offer_age)
         << " s: do the clocks of two hosts differ, or is a bag played without --clock and use_sim_time?";
    return text.str();
  }
  return "all samples are rejected, most often as: " + most->first;
}

std::vector<DiagnosticStatus> ManipulationDiagnostics::report(const std::vector<TrackerInput>& styluses,
                                                              const LoopStatistics& loop, double now) {
  last_.resize(styluses.size());
  std::vector<DiagnosticStatus> result;
  for (std::size_t hand = 0; hand < styluses.size(); ++hand) {
    const TrackerInput& stylus = styluses[hand];
    if (hand > 0 && stylus.hand.stream.samples == 0 && stylus.input.rejected.empty()) continue;
    const std::string what = hand > 0 ? "stylus " + std::to_string(hand + 1) : "tracker input";
    result.push_back(report_input(what, stylus, last_[hand], now));
  }
  result.push_back(report_loop(loop));
  last_ = styluses;
  last_loop_ = loop;
  return result;
}

DiagnosticStatus ManipulationDiagnostics::report_input(const std::string& what, const TrackerInput& tracker,
                                                       const TrackerInput& last, double now) const {
  const InputStatistics& input = tracker.input;
  const live::HandStatistics& hand = tracker.hand;
  ros_common::DiagnosticStatusBuilder status(name_ + ": " + what, "tracker");
  ros_common::add_stream(hand.stream, status);
  status.add("dropouts", hand.gate.dropouts)
      .add("relocations", hand.gate.relocations)
      .add("quaternion sign flips", hand.gate.sign_flips)
      .add("late samples", hand.reacquisition.late)
      .add("re-acquisitions", hand.reacquisition.reacquisitions)
      .add("losses", hand.reacquisition.losses)
      .add("moves of the tracker's frame", hand.tracker_moves)
      .add("steps of the sender's clock", input.clock_steps)
      .add("backward time jumps", input.restarts)
      .add("sent by", input.sender);
  const auto others = [](const InputStatistics& of) {
    const auto found = of.rejected.find(another_sender);
    return found == of.rejected.end() ? 0 : found->second;
  };
  if (others(input) > others(last.input)) {
    status.raise(DiagnosticStatus::ERROR,
                 "two nodes publish the stylus: using " + input.sender + ", ignoring " + input.other_sender);
  }
  if (hand.tracker_moves > last.hand.tracker_moves)
    status.warn("the tracker's frame was moved: the hand is re-acquired");
  std::vector<std::string> rejected;
  for (const auto& [reason, count] : input.rejected) {
    status.add("rejected: " + reason, count);
    const auto found = last.input.rejected.find(reason);
    const std::size_t before = found == last.input.rejected.end() ? 0 : found->second;
    if (count > before) rejected.push_back(increase(reason, before, count));
  }
  if (!tracker.hint.empty()) status.add("hint", tracker.hint);
  if (hand.stream.samples == 0) {
    return status.raise(DiagnosticStatus::STALE, tracker.hint.empty() ? "no sample yet" : tracker.hint).status();
  }
  const double silence = now - hand.newest_arrival;
  status.add("time since newest sample [s]", silence);
  if (silence > dropout_after_)
    status.warn("no samples: the hand stays at rest; is the tracker on, and the sensor in view?");
  if (hand.reacquisition.losses > last.hand.reacquisition.losses) {
    status.warn("the hand was lost");
    ROS_WARN_STREAM(what << ": the hand was lost: no sample for longer than input.loss_timeout");
  }
  if (hand.gate.dropouts > last.hand.gate.dropouts) {
    const std::string complaint = complaint_about_gaps(hand.gate, dropout_after_);
    const std::string counted = increase("dropouts", last.hand.gate.dropouts, hand.gate.dropouts);
    status.warn(complaint.empty() ? counted : complaint);
  }
  if (!rejected.empty()) status.warn("samples rejected: " + validation::join(rejected));
  return status.status();
}

DiagnosticStatus ManipulationDiagnostics::report_loop(const LoopStatistics& loop) const {
  ros_common::DiagnosticStatusBuilder status(name_ + ": physics loop", "simulation");
  const simulation::AdvanceReport& total = loop.advance;
  status.add("cycles", loop.cycles)
      .add("deadlines missed", loop.deadlines_missed)
      .add("steps", total.steps)
      .add("substeps", total.substeps)
      .add("stops", total.stops)
      .add("steps_fallback", total.steps_fallback)
      .add("steps_blocked", total.steps_blocked)
      .add("steps_unsolved", total.steps_unsolved)
      .add("steps_rejected", total.steps_rejected)
      .add("integrations_without_bound", total.integrations_without_bound)
      .add("collision_queries", total.collision_queries)
      .add("time_lost [s]", total.time_lost)
      .add("error_bound [m]", total.error_bound.value_or(std::numeric_limits<double>::infinity()))
      .add("simulated time skipped [s]", loop.time_skipped)
      .add("cycles behind the hands", loop.cycles_behind)
      .add("longest cycle [s]", loop.longest_cycle)
      .add("waits for unsent messages", loop.waits)
      .add("prediction error, 99 % [m]", loop.prediction_error)
      .add("real-time priority", loop.realtime_priority);
  status.add("time since the master's last reply [s]", loop.master_silence);
  if (loop.master_silence > master_timeout) {
    status.warn("the ROS master does not answer: current connections stay, new ones are impossible");
  }
  if (!loop.checkpoint_error.empty()) status.warn(loop.checkpoint_error);
  if (total.steps_rejected > last_loop_.advance.steps_rejected) {
    status.raise(DiagnosticStatus::ERROR,
                 increase("steps rejected", last_loop_.advance.steps_rejected, total.steps_rejected) +
                     ": no usable result, so the fork was rigid or, in contact, the object stood still: reduce step");
  }
  if (loop.deadlines_missed > last_loop_.deadlines_missed)
    status.warn(increase("deadlines missed", last_loop_.deadlines_missed, loop.deadlines_missed));
  if (loop.waits > last_loop_.waits)
    status.warn("publishing is too slow: lower the tracker's rate or remove subscribers");
  if (loop.time_skipped > last_loop_.time_skipped)
    status.warn(increase("simulated time skipped [s]", last_loop_.time_skipped, loop.time_skipped));
  if (loop.cycles_behind > last_loop_.cycles_behind)
    status.warn("slower than the hands: samples are dropped; use larger steps, a softer fork or fewer contacts");
  return status.status();
}

}  // namespace spring_workbench::manipulation
