#include "summary.h"

#include <cmath>
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

/// JSON has no word for what is not finite.
std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  out << value;
  return out.str();
}

std::string list_of(const std::vector<std::string>& words) {
  std::string json;
  for (const std::string& word : std::set<std::string>(words.begin(), words.end()))
    json += (json.empty() ? "" : ", ") + quoted(word);
  return "[" + json + "]";
}

/// {"reason": count, ...}, and their sum.
std::pair<std::string, std::size_t> rejected_of(const hand_input::GateCounts& gate) {
  std::string json;
  std::size_t sum = 0;
  for (const auto& [result, count] : gate.rejected) {
    json += (json.empty() ? "" : ", ") + quoted(hand_input::to_string(result)) + ": " + std::to_string(count);
    sum += count;
  }
  return {"{" + json + "}", sum};
}

}  // namespace

void Summary::add(const hand_input::GateCounts& of_hand) {
  gate.accepted += of_hand.accepted;
  gate.dropouts += of_hand.dropouts;
  for (const auto& [result, count] : of_hand.rejected) gate.rejected[result] += count;
}

void Summary::add(const hand_input::ReacquisitionCounts& of_hand) {
  hand.reacquisitions += of_hand.reacquisitions;
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
  const auto [rejected, samples_rejected] = rejected_of(gate);
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  out << "{\"steps\": " << advance.steps << ", \"simulated_time\": " << advance.simulated_time
      << ", \"wall_time\": " << wall_time
      << ", \"time_per_step\": " << (advance.steps > 0 ? wall_time / advance.steps : 0.0)
      << ", \"outputs\": " << outputs << ", \"samples\": " << samples << ", \"samples_rejected\": " << samples_rejected
      << ", \"rejected\": " << rejected << ", \"dropouts\": " << gate.dropouts
      << ", \"reacquisitions\": " << hand.reacquisitions << ", \"losses\": " << hand.losses
      << ", \"position_error\": " << number(advance.position_error)
      << ", \"angle_error\": " << number(advance.angle_error) << ", \"energy_drift\": " << number(advance.energy_added)
      << ", \"stiffest_omega_dt\": " << number(advance.stiffest_omega_dt) << ", \"contacts\": " << contacts_
      << ", \"collision_queries\": " << advance.collision_queries << ", \"substeps\": " << advance.substeps
      << ", \"energy_held\": " << advance.energy_held << ", \"steps_blocked\": " << advance.steps_blocked
      << ", \"steps_rejected\": " << advance.steps_rejected << ", \"state_hash\": \"" << simulation::to_hex(state_hash)
      << "\", \"active\": " << list_of(advance.active) << ", \"skipped\": " << list_of(advance.skipped) << "}";
  return out.str();
}

}  // namespace spring_workbench::replay
