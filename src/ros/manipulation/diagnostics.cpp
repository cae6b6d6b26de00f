#include "spring_workbench/ros/manipulation/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::manipulation {

using diagnostic_msgs::DiagnosticStatus;

std::string hint_for_silence(const InputStatistics& input, const std::vector<std::string>& senders,
                             const std::string& stylus_frame) {
  if (input.stream.samples > 0) return "";
  if (input.messages == 0 && senders.empty()) return "nobody sends /tf: is tracker_driver, or a bag, running?";
  if (input.messages == 0) {
    return validation::join(senders) +
           " should send /tf, but nothing comes: is ROS_IP or ROS_HOSTNAME set on the sender's host, and "
           "is the device on?";
  }
  if (input.frames.count(stylus_frame) == 0) {
    return "no frame " + stylus_frame + " on /tf, but " + validation::join({input.frames.begin(), input.frames.end()}) +
           ": is the parameter stylus_frame right?";
  }
  const auto most = std::max_element(input.left_out.begin(), input.left_out.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == input.left_out.end()) return "";
  if (most->first == "too old" || most->first == "from the future") {
    std::ostringstream text;
    text << "all samples are " << most->first << ", the newest by " << std::abs(input.newest_offer_age)
         << " s: are the clocks of two hosts apart, or is a bag played without --clock and use_sim_time?";
    return text.str();
  }
  return "all samples are left out, most for this: " + most->first;
}

std::vector<DiagnosticStatus> ManipulationDiagnostics::report(const TrackerInput& first, const TrackerInput& second,
                                                              const LoopStatistics& loop, double now) {
  std::vector<DiagnosticStatus> result{report_input("tracker input", first, last_first_, now), report_loop(loop)};
  const bool is_second = second.input.stream.samples > 0 || !second.input.left_out.empty();
  if (is_second) result.push_back(report_input("second stylus", second, last_second_, now));
  last_first_ = first;
  last_second_ = second;
  last_loop_ = loop;
  return result;
}

DiagnosticStatus ManipulationDiagnostics::report_input(const std::string& what, const TrackerInput& tracker,
                                                       const TrackerInput& last, double now) const {
  const InputStatistics& input = tracker.input;
  ros_common::DiagnosticStatusBuilder status(name_ + ": " + what, "tracker");
  ros_common::add_stream(input.stream, input.gate, status);
  status.add("came after their time was simulated", tracker.hand.late)
      .add("times the hand was found again", tracker.hand.reengagements)
      .add("times the hand was lost", tracker.hand.losses)
      .add("jumps back in time", input.restarts);
  bool more_left_out = false;
  for (const auto& [reason, count] : input.left_out) {
    status.add("left out: " + reason, count);
    const auto before = last.input.left_out.find(reason);
    more_left_out |= before == last.input.left_out.end() || before->second < count;
  }
  if (!tracker.hint.empty()) status.add("hint", tracker.hint);
  if (input.stream.samples == 0) {
    return status.raise(DiagnosticStatus::STALE, tracker.hint.empty() ? "no sample yet" : tracker.hint).status();
  }
  const double silence = now - input.newest_arrival;
  status.add("time since newest sample [s]", silence);
  if (silence > dropout_after_) status.raise(DiagnosticStatus::WARN, "no samples: the hand is held at rest");
  if (tracker.hand.losses > last.hand.losses) status.raise(DiagnosticStatus::WARN, "the hand was lost");
  if (input.gate.dropouts > last.input.gate.dropouts) status.raise(DiagnosticStatus::WARN, "dropouts");
  if (more_left_out) status.raise(DiagnosticStatus::WARN, "samples left out");
  return status.status();
}

DiagnosticStatus ManipulationDiagnostics::report_loop(const LoopStatistics& loop) const {
  ros_common::DiagnosticStatusBuilder status(name_ + ": physics loop", "simulation");
  status.add("cycles", loop.cycles)
      .add("deadlines missed", loop.deadlines_missed)
      .add("guards tripped", loop.guards_tripped)
      .add("leaps of time", loop.leaps)
      .add("longest cycle [s]", loop.longest_cycle);
  if (loop.guards_tripped > last_loop_.guards_tripped) {
    status.raise(DiagnosticStatus::ERROR, "steps refused: they would not have been finite or bounded");
  }
  if (loop.deadlines_missed > last_loop_.deadlines_missed) status.raise(DiagnosticStatus::WARN, "deadlines missed");
  if (loop.leaps > last_loop_.leaps) status.raise(DiagnosticStatus::WARN, "time leapt");
  return status.status();
}

}  // namespace spring_workbench::manipulation
