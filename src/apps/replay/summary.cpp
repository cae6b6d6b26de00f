#include "summary.h"

#include <algorithm>
#include <cstdio>
#include <locale>
#include <sstream>

namespace spring_workbench::replay {
namespace {

std::string quoted(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') json += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) {
      json += c;
    } else {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
      json += code;
    }
  }
  return json + "\"";
}

std::string list_of(const std::set<std::string>& words) {
  std::string json;
  for (const std::string& word : words) json += (json.empty() ? "" : ", ") + quoted(word);
  return "[" + json + "]";
}

/// {"reason": count, ...}, and their sum.
std::pair<std::string, std::size_t> left_out_of(const hand_input::GateCounts& gate) {
  std::string json;
  std::size_t sum = 0;
  for (const auto& [verdict, count] : gate.left_out) {
    json += (json.empty() ? "" : ", ") + quoted(hand_input::to_string(verdict)) + ": " + std::to_string(count);
    sum += count;
  }
  return {"{" + json + "}", sum};
}

}  // namespace

void Summary::add(const simulation::AdvanceReport& report) {
  total_.steps += report.steps;
  total_.simulated_time += report.simulated_time;
  total_.position_error = std::max(total_.position_error, report.position_error);
  total_.angle_error = std::max(total_.angle_error, report.angle_error);
  total_.energy_added += report.energy_added;
  total_.stiffest_omega_dt = std::max(total_.stiffest_omega_dt, report.stiffest_omega_dt);
  total_.collision_queries += report.collision_queries;
  total_.steps_rejected += report.steps_rejected;
  total_.energy_held += report.energy_held;
  total_.held_back += report.held_back;
  total_.guards_tripped += report.guards_tripped;
  parts_run_.insert(report.parts_run.begin(), report.parts_run.end());
  parts_left_out_.insert(report.parts_left_out.begin(), report.parts_left_out.end());
}

void Summary::add(const hand_input::GateCounts& of_hand) {
  gate.accepted += of_hand.accepted;
  gate.dropouts += of_hand.dropouts;
  for (const auto& [verdict, count] : of_hand.left_out) gate.left_out[verdict] += count;
}

void Summary::add(const hand_input::ReengagementCounts& of_hand) {
  hand.reengagements += of_hand.reengagements;
  hand.losses += of_hand.losses;
}

void Summary::add_contacts(const std::vector<contact::ContactState>& contacts) {
  std::set<Pair> now;
  for (const contact::ContactState& contact : contacts) {
    if (contact.phase != contact::ContactPhase::ended) now.emplace(contact.object, contact.other);
  }
  for (const Pair& pair : now) contacts_ += touching_.count(pair) == 0 ? 1 : 0;
  touching_ = now;
}

std::string Summary::json() const {
  std::set<std::string> never_run;
  std::set_difference(parts_left_out_.begin(), parts_left_out_.end(), parts_run_.begin(), parts_run_.end(),
                      std::inserter(never_run, never_run.end()));
  const auto [left_out, samples_left_out] = left_out_of(gate);
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  out << "{\"steps\": " << total_.steps << ", \"simulated_time\": " << total_.simulated_time
      << ", \"wall_time\": " << wall_time
      << ", \"time_per_step\": " << (total_.steps > 0 ? wall_time / total_.steps : 0.0) << ", \"outputs\": " << outputs
      << ", \"samples\": " << samples << ", \"samples_left_out\": " << samples_left_out
      << ", \"left_out\": " << left_out << ", \"dropouts\": " << gate.dropouts
      << ", \"reengagements\": " << hand.reengagements << ", \"losses\": " << hand.losses
      << ", \"position_error\": " << total_.position_error << ", \"angle_error\": " << total_.angle_error
      << ", \"energy_drift\": " << total_.energy_added << ", \"stiffest_omega_dt\": " << total_.stiffest_omega_dt
      << ", \"contacts\": " << contacts_ << ", \"collision_queries\": " << total_.collision_queries
      << ", \"steps_rejected\": " << total_.steps_rejected << ", \"energy_held\": " << total_.energy_held
      << ", \"held_back\": " << total_.held_back << ", \"guards_tripped\": " << total_.guards_tripped
      << ", \"parts_run\": " << list_of(parts_run_) << ", \"parts_left_out\": " << list_of(never_run) << "}";
  return out.str();
}

}  // namespace spring_workbench::replay
