#include "summary.h"

#include <cmath>
#include <locale>
#include <sstream>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::replay {
namespace {

/// Quotes a word that needs no escapes.
std::string quoted(const std::string& word) { return '"' + word + '"'; }

/// A number in JSON, which has no infinities or NaN.
std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  out << value;
  return out.str();
}

std::string list_of(const std::vector<std::string>& words) {
  std::vector<std::string> entries;
  for (const std::string& word : std::set<std::string>(words.begin(), words.end())) entries.push_back(quoted(word));
  return "[" + validation::join(entries) + "]";
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

void Summary::add_state(const simulation::Simulation& simulation) {
  for (std::size_t hand = 0; hand < simulation.hands(); ++hand) {
    const tools::ToolState tool = simulation.tool(hand);
    held_ = held_ || !tool.held_object.empty() || !tool.touched.empty();
  }
  std::set<Pair> now;
  for (const contact::ContactState& contact : simulation.contacts()) {
    if (contact.phase != contact::ContactPhase::ended) now.emplace(contact.object, contact.other);
  }
  for (const Pair& pair : now) contacts_ += touching_.count(pair) == 0 ? 1 : 0;
  touching_ = now;
}

std::size_t Summary::samples_rejected() const {
  std::size_t sum = 0;
  for (const auto& [result, count] : gate.rejected) sum += count;
  return sum;
}

std::vector<std::string> Summary::warnings() const {
  std::vector<std::string> found;
  if (2 * samples_rejected() > samples) {
    found.push_back(
        std::to_string(samples_rejected()) + " of " + std::to_string(samples) +
        " samples were rejected: are positions in metres and times in seconds? The limits are the settings input.*");
  }
  if (advance.steps_fallback * fallback_share > static_cast<double>(advance.steps)) {
    found.push_back("the integrator failed in " + std::to_string(advance.steps_fallback) +
                    " integrations, which the fallback rule then took: decrease step or choose another integrator");
  }
  if (!held_) found.push_back("no object was held or probed: grasp with the button, or name one in grasp.object");
  return found;
}

std::string Summary::json() const {
  std::vector<std::string> rejected;
  for (const auto& [result, count] : gate.rejected) {
    rejected.push_back(quoted(hand_input::to_string(result)) + ": " + std::to_string(count));
  }
  const auto bound = [](const std::optional<double>& b) { return b ? number(*b) : "null"; };
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << "{\"steps\": " << advance.steps << ", \"simulated_time\": " << number(advance.simulated_time)
      << ", \"wall_time\": " << number(wall_time)
      << ", \"time_per_step\": " << number(advance.steps > 0 ? wall_time / static_cast<double>(advance.steps) : 0.0)
      << ", \"outputs\": " << outputs << ", \"samples\": " << samples
      << ", \"samples_rejected\": " << samples_rejected() << ", \"rejected\": {" << validation::join(rejected)
      << "}, \"dropouts\": " << gate.dropouts << ", \"reacquisitions\": " << hand.reacquisitions
      << ", \"losses\": " << hand.losses << ", \"position_error\": " << number(advance.position_error)
      << ", \"angle_error\": " << number(advance.angle_error) << ", \"error_bound\": " << bound(advance.error_bound)
      << ", \"angle_error_bound\": " << bound(advance.angle_error_bound)
      << ", \"local_error_bound\": " << bound(advance.local_error_bound)
      << ", \"integrations_without_bound\": " << advance.integrations_without_bound
      << ", \"energy_balance\": " << number(advance.energy_balance)
      << ", \"stiffest_omega_dt\": " << number(advance.stiffest_omega_dt) << ", \"contacts\": " << contacts_
      << ", \"collision_queries\": " << advance.collision_queries << ", \"substeps\": " << advance.substeps
      << ", \"stops\": " << advance.stops << ", \"steps_fallback\": " << advance.steps_fallback
      << ", \"steps_blocked\": " << advance.steps_blocked << ", \"steps_unsolved\": " << advance.steps_unsolved
      << ", \"time_lost\": " << number(advance.time_lost) << ", \"steps_rejected\": " << advance.steps_rejected
      << ", \"changes\": " << changes.repeated + changes.restored << ", \"changes_replayed\": " << changes.repeated
      << ", \"changes_mismatched\": " << changes.mismatches.size() << ", \"state_hash\": \"" << math::to_hex(state_hash)
      << "\", \"active\": " << list_of(advance.active()) << ", \"skipped\": " << list_of(advance.skipped()) << "}";
  return out.str();
}

}  // namespace spring_workbench::replay
